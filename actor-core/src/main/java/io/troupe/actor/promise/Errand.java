package io.troupe.actor.promise;

/** Something that another thread wants done to a promise on the thread of its home. */
final class Errand extends Node {
    private final Runnable action;

    Errand(Runnable action) {
        this.action = action;
    }

    @Override
    protected void run() {
        action.run();
    }
}
