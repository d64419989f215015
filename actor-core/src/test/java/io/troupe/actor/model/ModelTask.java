package io.troupe.actor.model;

import org.jspecify.annotations.Nullable;

/**
 * A queued entry.
 *
 * @param message true if it is a message, false if it is a callback
 * @param ifClosed what runs instead after the space has stopped; null = the same
 */
record ModelTask(boolean message, Runnable action, @Nullable Runnable ifClosed) {
    static ModelTask callback(Runnable action) {
        return new ModelTask(false, action, null);
    }

    static ModelTask call(Runnable action) {
        return new ModelTask(true, action, null);
    }

    /** A task of the space itself, not a call of an actor. */
    static ModelTask entry(Runnable action, Runnable ifClosed) {
        return new ModelTask(true, action, ifClosed);
    }
}
