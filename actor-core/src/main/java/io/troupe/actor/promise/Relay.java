package io.troupe.actor.promise;

/** A listener of our own that only passes an outcome on, so that it may run on whichever thread settles the promise. */
final class Relay extends Node {
    private final Runnable action;

    Relay(Runnable action) {
        this.action = action;
    }

    @Override
    protected void run() {
        action.run();
    }
}
