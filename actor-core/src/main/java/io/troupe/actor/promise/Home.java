package io.troupe.actor.promise;

import java.time.Duration;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * An event loop: the single thread that owns actors, promises and listeners.
 *
 * <p><b>Role.</b> Promises run their listeners on their home's thread; {@code ActorSpace} is the home of actors.
 * Internal to this library.
 *
 * <p><b>Threads.</b> {@link #enqueue}, {@link #schedule} and {@link #rejected} from any thread, the rest on the home's
 * thread.
 */
public abstract class Home {
    private static final ThreadLocal<@Nullable Home> CURRENT = new ThreadLocal<>();

    final DetachedListeners detachedListeners = new DetachedListeners(); // of this home's thread
    final Owner outsider;
    private final Owner self;
    private CurrentOwner turn;

    /** @hidden */
    @SuppressWarnings("this-escape") // owners only store the reference, and do not use it before the first node runs
    protected Home() {
        outsider = new Owner(this, true);
        self = new Owner(this);
        turn = new CurrentOwner(self);
    }

    /** The home whose thread is calling, or null. */
    public static @Nullable Home current() {
        return CURRENT.get();
    }

    /**
     * Makes the calling thread this home's thread until {@link #leaveThread}.
     *
     * @return the home to which the thread belonged before, or null
     * @hidden
     */
    protected final @Nullable Home enterThread() {
        Home before = CURRENT.get();
        CURRENT.set(this);
        return before;
    }

    /**
     * Restores the home to which the calling thread belonged before.
     *
     * @param before what {@link #enterThread} returned
     * @hidden
     */
    protected static void leaveThread(@Nullable Home before) {
        if (before == null) {
            CURRENT.remove();
        } else {
            CURRENT.set(before);
        }
    }

    /**
     * True on this home's thread.
     *
     * @hidden
     */
    protected abstract boolean isCurrent();

    /**
     * Queues a node; first in, first out per sender.
     *
     * @hidden
     */
    protected abstract void enqueue(Node node);

    /**
     * Like {@link #enqueue} from another thread, even if called on this home's thread: the node goes behind those that
     * other threads have queued.
     *
     * @hidden
     */
    protected abstract void enqueueAsRemote(Node node);

    /**
     * Like {@link #enqueue}, called on this home's thread.
     *
     * @hidden
     */
    protected abstract void enqueueAtHome(Node node);

    /**
     * Runs a task after a delay, or the other one if the home is closed first. If called on this home's thread, the
     * task runs there. Otherwise it runs on a separate thread that does not depend on the home, unless the home uses a
     * manual clock.
     *
     * @return cancels the task, from any thread
     * @hidden
     */
    protected abstract Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed);

    /**
     * Called when a promise without listeners was rejected. The home checks again a little later and reports the
     * rejection if there is still no listener.
     *
     * @hidden
     */
    protected abstract void rejected(Promise<?> promise, Throwable error);

    /**
     * Called when a promise was rejected after every listener had timed out.
     *
     * @hidden
     */
    protected void rejectedTooLate(Promise<?> promise, Throwable error) {
        rejected(promise, error);
    }

    /**
     * Suspends a sequential body until the promise is settled, and runs other work meanwhile; throws for any other
     * caller.
     *
     * @hidden
     */
    protected abstract void await(Promise<?> promise);

    /**
     * Sets the owner on whose behalf this home's thread now runs.
     *
     * @hidden
     */
    protected final void begin(Owner owner) {
        CurrentOwner now = turn;
        if (now.owner != owner) {
            now.owner = owner;
        }
    }

    /**
     * Sets this home itself as the owner on whose behalf its thread now runs.
     *
     * @hidden
     */
    protected final void beginForItself() {
        begin(self);
    }

    /**
     * The owner on whose behalf this home's thread is running.
     *
     * @hidden
     */
    protected final Owner owner() {
        return turn.owner;
    }

    /**
     * The owner for work of the home itself.
     *
     * @hidden
     */
    protected final Owner itself() {
        return self;
    }

    /**
     * Replaces the holder of the current owner; called periodically, see {@link CurrentOwner}.
     *
     * @hidden
     */
    protected final void renewTurn() {
        turn = new CurrentOwner(turn.owner);
    }

    /**
     * A duration in nanoseconds, saturated at the range of a long (about 292 years).
     *
     * @hidden
     */
    protected static long nanosOf(Duration duration) {
        try {
            return duration.toNanos();
        } catch (ArithmeticException tooLong) {
            return duration.isNegative() ? Long.MIN_VALUE : Long.MAX_VALUE;
        }
    }

    // ---- access to nodes and promises for subclasses

    /**
     * True if a callback that is queued now, on this home's thread, would run before everything else.
     *
     * @hidden
     */
    protected boolean isNextCallbackFirst() {
        return false;
    }

    /**
     * Runs a queued node; see {@link Node#serve}.
     *
     * @hidden
     */
    protected static @Nullable Node serve(Node node) throws Throwable {
        return node.serve();
    }

    /**
     * Passes an exception thrown by a node to the node's handler.
     *
     * @hidden
     */
    protected static void threw(Node node, Throwable thrown) {
        node.threw(thrown);
    }

    /**
     * True if a node goes to a mailbox.
     *
     * @hidden
     */
    protected static boolean isMessage(Node node) {
        return node.isMessage();
    }

    /**
     * True if the promise was made by a thread outside the home, which may be about to register a listener.
     *
     * @hidden
     */
    protected static boolean isMadeOutside(Promise<?> promise) {
        return promise.madeOutside();
    }

    /**
     * True if the promise has, or had, a listener that receives its outcome.
     *
     * @hidden
     */
    protected static boolean isHandled(Promise<?> promise) {
        return promise.isHandled();
    }

    /**
     * Runs an action when the promise is settled, on the thread that settles it.
     *
     * @param isOver true once the action is no longer needed, so that the promise may drop it; called by any thread
     * @hidden
     */
    protected static void whenSettled(Promise<?> promise, BooleanSupplier isOver, Runnable action) {
        promise.register(new InlineListener(action, isOver));
    }

    /**
     * Creates a promise of a given home that is settled by hand. The action runs on the calling thread when the promise
     * is cancelled.
     *
     * @hidden
     */
    protected static <T extends @Nullable Object> Deferred<T> cancellable(Home home, Runnable ifCancelled) {
        return new Deferred<>(home, ifCancelled);
    }

    /**
     * Holds the owner on whose behalf a home's thread is running. This is a separate object that is replaced
     * periodically, because the field is written at every turn, and storing a reference into an object of the old
     * generation costs a fence under G1 (until JEP 522, JDK 26).
     */
    private static final class CurrentOwner {
        Owner owner;

        CurrentOwner(Owner owner) {
            this.owner = owner;
        }
    }
}
