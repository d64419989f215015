package io.troupe.actor.promise;

/** A listener of our own that only passes an outcome on, so that it may run on whichever thread settles the promise. */
final class Relay extends Node {
    private final Runnable action;
    private final Promise<?> reader;

    /**
     * A relay.
     *
     * @param reader the promise for whose sake it listens: settled, it needs nothing any more
     */
    Relay(Runnable action, Promise<?> reader) {
        this.action = action;
        this.reader = reader;
    }

    @Override
    protected void run() {
        action.run();
    }

    @Override
    boolean isIdle() {
        return reader.isDone();
    }
}
