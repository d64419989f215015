package io.troupe.actor;

import io.troupe.actor.internal.loop.QueueEntry;
import org.jspecify.annotations.Nullable;

/** A task on a space's thread that is not a call of an actor. */
final class Entry extends QueueEntry {
    private final Runnable task;
    private final @Nullable Runnable ifClosed;
    private final boolean message;

    private Entry(Runnable task, @Nullable Runnable ifClosed, boolean message) {
        this.task = task;
        this.ifClosed = ifClosed;
        this.message = message;
    }

    /** A task in message order. */
    Entry(Runnable task) {
        this(task, null, true);
    }

    /** A task in message order; if the space is closed first, the other task runs instead. */
    Entry(Runnable task, Runnable ifClosed) {
        this(task, ifClosed, true);
    }

    /**
     * A task in the callback queue, before queued messages; if the space is closed first, the other task runs instead.
     */
    static Entry urgent(Runnable task, Runnable ifClosed) {
        return new Entry(task, ifClosed, false);
    }

    /** The task to run if the space has been closed, or null if there is none. */
    @Nullable
    Runnable ifClosed() {
        return ifClosed;
    }

    @Override
    protected @Nullable QueueEntry serve() {
        task.run();
        return null;
    }

    @Override
    protected boolean isMessage() {
        return message;
    }
}
