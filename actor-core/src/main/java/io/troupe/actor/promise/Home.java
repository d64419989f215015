package io.troupe.actor.promise;

import org.jspecify.annotations.Nullable;

/**
 * The one thread something belongs to.
 *
 * <p><b>Role.</b> Promises run their listeners at home; {@code ActorSpace} is the home of actors. For the rooms of this library.
 * <p><b>Threads.</b> {@link #enqueue}, {@link #schedule} and {@link #rejected} from any thread, the rest on the home's own thread.
 */
public abstract class Home {
    private static final ThreadLocal<@Nullable Home> CURRENT = new ThreadLocal<>();

    /** The home whose thread is calling, or null. */
    public static @Nullable Home current() {
        return CURRENT.get();
    }

    /**
     * Declares the calling thread to be this home's until {@link #leaveThread}.
     *
     * @return whose it was before
     */
    protected final @Nullable Home enterThread() {
        Home before = CURRENT.get();
        CURRENT.set(this);
        return before;
    }

    /** Declares the calling thread to be what it was before. */
    protected static void leaveThread(@Nullable Home before) {
        if (before == null) {
            CURRENT.remove();
        } else {
            CURRENT.set(before);
        }
    }

    /** Whether the calling thread is this home's. */
    protected abstract boolean isCurrent();

    /** Queues a node; first in, first out per sender. */
    protected abstract void enqueue(Node node);

    /** Runs the task on this home's thread after a delay; the answer takes it back, from any thread. */
    protected abstract Runnable schedule(long delayNanos, Runnable task);

    /** On whose behalf this home's thread is running: an actor, or null. */
    protected abstract @Nullable Object owner();

    /** Runs a listener on behalf of an owner; false, and nothing is done, if the owner does not take callbacks any more. */
    protected abstract boolean runFor(Object owner, Runnable listener);

    /** A promise was rejected while nobody listened; the home looks again a little later and reports it if that is still so. */
    protected abstract void rejected(Promise<?> promise, Throwable error);

    /** Whether a thread outside made the promise and may be just about to listen to it. */
    protected static boolean isMadeOutside(Promise<?> promise) {
        return promise.madeOutside();
    }

    /** Runs a node; the access to {@link Node#run} that homes have. */
    protected static void run(Node node) {
        node.run();
    }

    /** The access to {@link Node#isMail} that homes have. */
    protected static boolean isMail(Node node) {
        return node.isMail();
    }
}
