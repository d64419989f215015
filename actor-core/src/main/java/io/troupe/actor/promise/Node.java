package io.troupe.actor.promise;

import org.jspecify.annotations.Nullable;

/**
 * Something that can wait in a queue for its {@link Home}'s thread.
 *
 * <p><b>Role.</b> For generated code and for the rooms of this library, not for applications: a message, a request and
 * a listener are nodes, so that queueing one allocates nothing.
 *
 * @hidden
 */
public abstract class Node {
    /** Link to another node; owned by the queue, or by the promise it listens to, that holds this node. */
    @Nullable
    Node next;

    /** Does what this node is for, on its home's thread; whoever calls this passes what it throws to {@link #threw}. */
    protected abstract void run() throws Throwable;

    /**
     * Runs this as an entry of a queue. A request whose answer has exactly one listener, which comes next in any case,
     * returns that listener: the queue of callbacks is then passed by.
     *
     * @return the callback that must be served next, before anything else, or null
     */
    protected @Nullable Node serve() throws Throwable {
        run();
        return null;
    }

    /** Deals with what {@link #run} has thrown; throws it again if that is not this node's business. */
    protected void threw(Throwable thrown) {
        throw Errors.rethrow(thrown);
    }

    /** Whether this goes to a mailbox; everything else goes to the callback queue, which is served first. */
    protected boolean isMail() {
        return false;
    }

    /**
     * Whether this listens for somebody who needs no answer any more, so that the promise it listens to may forget it.
     */
    boolean isIdle() {
        return false;
    }

    /**
     * Whether this listener has been given up because of a time limit, so that a failure that comes later has to be
     * reported elsewhere.
     */
    boolean hasTimedOut() {
        return false;
    }
}
