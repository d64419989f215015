package io.troupe.actor.promise;

import org.jspecify.annotations.Nullable;

/**
 * An entry of a {@link Home}'s queues.
 *
 * <p><b>Role.</b> Messages, requests and listeners are nodes, so queueing one allocates nothing. For generated code and
 * internal use, not for applications.
 *
 * @hidden
 */
public abstract class Node {
    /** Link to another node; owned by the queue, or by the promise, that currently holds this node. */
    @Nullable
    Node next;

    /** Runs this node on its home's thread; the caller passes what it throws to {@link #threw}. */
    protected abstract void run() throws Throwable;

    /**
     * Runs this as an entry of a queue. If a request's result has exactly one listener, and that listener would run
     * next anyway, it is returned instead of being queued.
     *
     * @return the callback that must be run next, before anything else, or null
     */
    protected @Nullable Node serve() throws Throwable {
        run();
        return null;
    }

    /** Handles what {@link #run} has thrown; rethrows it if this node has no handler. */
    protected void threw(Throwable thrown) {
        throw Errors.rethrow(thrown);
    }

    /** True if this goes to a mailbox; everything else goes to the callback queue, which is drained first. */
    protected boolean isMessage() {
        return false;
    }

    /** True if this listener no longer needs the outcome, so that the promise may drop it. */
    boolean isIdle() {
        return false;
    }

    /** True if this listener has timed out, so that a later failure must be reported elsewhere. */
    boolean hasTimedOut() {
        return false;
    }
}
