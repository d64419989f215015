package io.troupe.actor;

/** The task of a timer, and the task that runs instead if the space is closed first. */
record Expiry(Runnable task, Runnable ifClosed) implements Runnable {
    @Override
    public void run() {
        task.run();
    }
}
