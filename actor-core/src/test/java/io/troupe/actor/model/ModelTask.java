package io.troupe.actor.model;

import org.jspecify.annotations.Nullable;

/**
 * Something that waits.
 *
 * @param mail whether it waits in a mailbox or in a callback queue
 * @param ifClosed what happens instead when serving has ended; null = the same
 */
record ModelTask(boolean mail, Runnable action, @Nullable Runnable ifClosed) {
    static ModelTask callback(Runnable action) {
        return new ModelTask(false, action, null);
    }

    static ModelTask call(Runnable action) {
        return new ModelTask(true, action, null);
    }

    /** The space's own business, no call of an actor. */
    static ModelTask entry(Runnable action, Runnable ifClosed) {
        return new ModelTask(true, action, ifClosed);
    }
}
