package io.troupe.actor;

/** What a timer does, and what happens instead if its space is closed before. */
record Expiry(Runnable task, Runnable ifClosed) implements Runnable {
    @Override
    public void run() {
        task.run();
    }
}
