package io.troupe.actor.internal.loop;

import org.jspecify.annotations.Nullable;

/**
 * An entry of a {@link Home}'s queues. Internal to this library.
 *
 * <p><b>Role.</b> Messages, requests and listeners are entries, so queueing one allocates nothing. A promise is an
 * entry, so nothing here is public: the library uses {@link QueueEntries}.
 */
public abstract class QueueEntry {
    /** Link to another entry; owned by the queue, or by the promise, that currently holds this entry. */
    @Nullable
    QueueEntry next;

    protected QueueEntry() {}

    /**
     * Runs this entry on its home's thread; the caller passes what it throws to {@link #threw}. If a request's result
     * has exactly one listener, and that listener would run next anyway, it is returned instead of being queued.
     *
     * @return the callback that must be run next, before anything else, or null
     */
    protected @Nullable QueueEntry serve() throws Throwable {
        throw new IllegalStateException("this is never run: " + this);
    }

    /** Handles what {@link #serve} has thrown; rethrows it if this entry has no handler. */
    protected void threw(Throwable thrown) {
        throw QueueEntries.rethrow(thrown);
    }

    /** True if this goes to a mailbox; everything else goes to the callback queue, which is drained first. */
    protected boolean isMessage() {
        return false;
    }

    /** The owner on whose behalf this message runs; null if it decides that by itself. */
    protected @Nullable TurnOwner turnOwner() {
        return null;
    }

    /** True if this is that call, or the entry for it. */
    protected boolean carries(QueueEntry wanted) {
        return this == wanted;
    }

    /** True if this listener no longer needs the outcome, so that the promise may drop it. */
    protected boolean isIdle() {
        return false;
    }

    /** True if this listener has timed out, so that a later failure must be reported elsewhere. */
    protected boolean hasTimedOut() {
        return false;
    }
}
