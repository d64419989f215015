package io.troupe.actor.internal.loop;

import java.time.Duration;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * An event loop: the single thread that owns actors, promises and listeners. Internal to this library.
 *
 * <p><b>Role.</b> Promises run their listeners on their home's thread; each actor space has one.
 *
 * <p><b>Threads.</b> {@link #enqueue}, {@link #schedule} and {@link #rejected} from any thread, the rest on the home's
 * thread.
 */
public abstract class Home {
    private static final ThreadLocal<@Nullable Home> CURRENT = new ThreadLocal<>();

    private final TurnOwner outsider;
    private final TurnOwner self;
    private CurrentOwner turn;

    @SuppressWarnings("this-escape") // owners only store the reference, and do not use it before the first entry runs
    protected Home() {
        outsider = new TurnOwner(this, true);
        self = new TurnOwner(this);
        turn = new CurrentOwner(self);
    }

    /** The home whose thread is calling, or null. */
    public static @Nullable Home current() {
        return CURRENT.get();
    }

    // ---- the thread

    /** True on this home's thread. */
    public abstract boolean isCurrent();

    /**
     * Makes the calling thread this home's thread until {@link #leaveThread}.
     *
     * @return the home to which the thread belonged before, or null
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
     */
    public static void leaveThread(@Nullable Home before) {
        if (before == null) {
            CURRENT.remove();
        } else {
            CURRENT.set(before);
        }
    }

    /** True if this home processes no further entries, and only rejects them; exact on its thread. */
    public abstract boolean isEnding();

    // ---- queueing

    /** Queues an entry as a callback; first in, first out per sender. */
    public abstract void enqueue(QueueEntry node);

    /**
     * Like {@link #enqueue} from another thread, even if called on this home's thread: the entry goes behind those that
     * other threads have queued.
     */
    public abstract void enqueueAsRemote(QueueEntry node);

    /** Like {@link #enqueue}, called on this home's thread. */
    public abstract void enqueueAtHome(QueueEntry node);

    /** True if a callback that is queued now, on this home's thread, would run before everything else. */
    public boolean isNextCallbackFirst() {
        return false;
    }

    // ---- services for promises

    /**
     * Captures the context of the calling thread, for a listener that will run in this home.
     *
     * @return restores the context, and returns what ends it; null if there is nothing to carry
     */
    public @Nullable Supplier<Runnable> captureContext() {
        return null;
    }

    /**
     * Runs a task after a delay, or the other one if the home is closed first. If called on this home's thread, the
     * task runs there. Otherwise it runs on a separate thread that does not depend on the home, unless the home uses a
     * manual clock.
     *
     * @return cancels the task, from any thread
     */
    public abstract Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed);

    /**
     * Called when a promise without listeners was rejected. The home checks again a little later and reports the
     * rejection if there is still no listener.
     *
     * @param promise a promise, which this package cannot name
     */
    public abstract void rejected(QueueEntry promise, Throwable error);

    /** Called when a promise was rejected after every listener had timed out. */
    public void rejectedTooLate(QueueEntry promise, Throwable error) {
        rejected(promise, error);
    }

    /**
     * Suspends a sequential body until the promise is settled, and runs other work meanwhile; throws for any other
     * caller.
     *
     * @param promise a promise, which this package cannot name
     */
    public abstract void await(QueueEntry promise);

    /** Called when a time limit that was set here has passed; by any thread. */
    public void limitExpired() {}

    // ---- owners

    /** Runs a task on behalf of this home itself, on its thread; what it throws is reported. */
    protected abstract void runGuarded(Runnable task);

    /** Sets the owner on whose behalf this home's thread now runs. */
    public final void begin(TurnOwner owner) {
        CurrentOwner now = turn;
        if (now.owner != owner) {
            now.owner = owner;
        }
        now.isKept = false;
    }

    /**
     * Makes the {@link #keptOwner} the one on whose behalf this home's thread now runs. Storing no reference saves the
     * collector's barriers, for most messages.
     */
    public final void beginForKept() {
        turn.isKept = true;
    }

    /** Sets this home itself as the owner on whose behalf its thread now runs. */
    public final void beginForItself() {
        begin(self);
    }

    /** The owner on whose behalf this home's thread is running. */
    public final TurnOwner owner() {
        CurrentOwner now = turn;
        return now.isKept ? keptOwner() : now.owner;
    }

    /** The owner of the message that the home keeps while it runs. */
    protected TurnOwner keptOwner() {
        return self;
    }

    /** The owner for work of the home itself. */
    public final TurnOwner itself() {
        return self;
    }

    /** The owner for threads outside every home. */
    public final TurnOwner outsider() {
        return outsider;
    }

    /** Replaces the holder of the current owner; called periodically, see {@link CurrentOwner}. */
    public final void renewTurn() {
        turn = new CurrentOwner(turn.owner);
    }

    /** A duration in nanoseconds, saturated at the range of a long (about 292 years). */
    public static long nanosOf(Duration duration) {
        try {
            return duration.toNanos();
        } catch (ArithmeticException tooLong) {
            return duration.isNegative() ? Long.MIN_VALUE : Long.MAX_VALUE;
        }
    }

    /**
     * Holds the owner on whose behalf a home's thread is running. This is a separate object that is replaced
     * periodically, because the field is written at every turn, and storing a reference into an object of the old
     * generation costs a fence under G1 (until JEP 522, JDK 26). The home's fields are on cache lines that senders read
     * at every message, so nothing that every turn writes belongs there.
     */
    private static final class CurrentOwner {
        TurnOwner owner;
        boolean isKept; // then the home's kept owner counts

        CurrentOwner(TurnOwner owner) {
            this.owner = owner;
        }
    }
}
