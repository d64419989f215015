package io.troupe.actor.promise;

import java.util.function.BooleanSupplier;

/** A listener of our own that only passes an outcome on, so that it may run on whichever thread settles the promise. */
final class Relay extends Node {
    private final Runnable action;
    private final BooleanSupplier isOver;

    /**
     * A relay.
     *
     * @param reader the promise for whose sake it listens: settled, it needs nothing any more
     */
    Relay(Runnable action, Promise<?> reader) {
        this(action, reader::isDone);
    }

    /**
     * A relay.
     *
     * @param isOver whether it needs nothing any more; asked by any thread
     */
    Relay(Runnable action, BooleanSupplier isOver) {
        this.action = action;
        this.isOver = isOver;
    }

    @Override
    protected void run() {
        action.run();
    }

    @Override
    boolean isIdle() {
        return isOver.getAsBoolean();
    }
}
