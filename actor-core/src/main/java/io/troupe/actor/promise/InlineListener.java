package io.troupe.actor.promise;

import java.util.function.BooleanSupplier;

/** An internal listener that only passes an outcome on, so it may run on any thread that settles the promise. */
final class InlineListener extends Node {
    private final Runnable action;
    private final BooleanSupplier isOver;

    /**
     * Creates a relay for another promise.
     *
     * @param reader the promise that needs the outcome; once it is settled, this relay is no longer needed
     */
    InlineListener(Runnable action, Promise<?> reader) {
        this(action, reader::isDone);
    }

    /**
     * Creates a relay.
     *
     * @param isOver true once this relay is no longer needed; called by any thread
     */
    InlineListener(Runnable action, BooleanSupplier isOver) {
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
