package io.troupe.actor.promise;

import java.time.Duration;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * The one thread something belongs to.
 *
 * <p><b>Role.</b> Promises run their listeners at home; {@code ActorSpace} is the home of actors. For the rooms of this
 * library.
 *
 * <p><b>Threads.</b> {@link #enqueue}, {@link #schedule} and {@link #rejected} from any thread, the rest on the home's
 * own thread.
 */
public abstract class Home {
    private static final ThreadLocal<@Nullable Home> CURRENT = new ThreadLocal<>();

    final Owner outsider;
    private final Owner self;
    private Turn turn;

    /** @hidden */
    @SuppressWarnings("this-escape") // owners keep the home, and ask it nothing before there is something to run
    protected Home() {
        outsider = new Owner(this, true);
        self = new Owner(this);
        turn = new Turn(self);
    }

    /** The home whose thread is calling, or null. */
    public static @Nullable Home current() {
        return CURRENT.get();
    }

    /**
     * Declares the calling thread to be this home's until {@link #leaveThread}.
     *
     * @return whose it was before
     * @hidden
     */
    protected final @Nullable Home enterThread() {
        Home before = CURRENT.get();
        CURRENT.set(this);
        return before;
    }

    /**
     * Declares the calling thread to be what it was before.
     *
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
     * Whether the calling thread is this home's.
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
     * As {@link #enqueue} from another thread, whoever calls: behind what other threads have queued.
     *
     * @hidden
     */
    protected abstract void enqueueFromAfar(Node node);

    /**
     * As {@link #enqueue}, on this home's thread.
     *
     * @hidden
     */
    protected abstract void enqueueAtHome(Node node);

    /**
     * Runs a task after a delay, or, if the home is closed before, the other one; on this home's thread if that is
     * calling, else on one that does not wait for the home, unless the home's clock is moved by hand.
     *
     * @return takes it back, from any thread
     * @hidden
     */
    protected abstract Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed);

    /**
     * A promise was rejected while nobody listened; the home looks again a little later and reports it if that is still
     * so.
     *
     * @hidden
     */
    protected abstract void rejected(Promise<?> promise, Throwable error);

    /**
     * A promise was rejected after all its listeners had been given up because of time limits.
     *
     * @hidden
     */
    protected void rejectedTooLate(Promise<?> promise, Throwable error) {
        rejected(promise, error);
    }

    /**
     * Lets others run until the promise is settled, if the caller is a sequential body; else throws.
     *
     * @hidden
     */
    protected abstract void await(Promise<?> promise);

    /**
     * From now on this home's thread runs on behalf of that owner.
     *
     * @hidden
     */
    protected final void begin(Owner owner) {
        Turn now = turn;
        if (now.owner != owner) {
            now.owner = owner;
        }
    }

    /**
     * From now on this home's thread runs on its own behalf.
     *
     * @hidden
     */
    protected final void beginForItself() {
        begin(self);
    }

    /**
     * On whose behalf this home's thread is running.
     *
     * @hidden
     */
    protected final Owner owner() {
        return turn.owner;
    }

    /**
     * The owner of what runs on this home's own behalf.
     *
     * @hidden
     */
    protected final Owner itself() {
        return self;
    }

    /**
     * To be called now and then, see {@link Turn}.
     *
     * @hidden
     */
    protected final void renewTurn() {
        turn = new Turn(turn.owner);
    }

    /**
     * A duration in nanoseconds, or as many as can be counted: some 292 years.
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

    // ---- what homes may do with nodes and promises

    /**
     * Whether a callback that is queued now, on this home's thread, comes before everything else.
     *
     * @hidden
     */
    protected boolean isNextCallbackFirst() {
        return false;
    }

    /**
     * Serves a node; see {@link Node#serve}.
     *
     * @hidden
     */
    protected static @Nullable Node serve(Node node) throws Throwable {
        return node.serve();
    }

    /**
     * Lets a node deal with what running it has thrown.
     *
     * @hidden
     */
    protected static void threw(Node node, Throwable thrown) {
        node.threw(thrown);
    }

    /**
     * Whether a node goes to a mailbox.
     *
     * @hidden
     */
    protected static boolean isMail(Node node) {
        return node.isMail();
    }

    /**
     * Whether a thread outside made the promise and may be just about to listen to it.
     *
     * @hidden
     */
    protected static boolean isMadeOutside(Promise<?> promise) {
        return promise.madeOutside();
    }

    /**
     * Whether anybody was or will be told how the promise ends.
     *
     * @hidden
     */
    protected static boolean isHeard(Promise<?> promise) {
        return promise.isHeard();
    }

    /**
     * Runs an action when the promise is settled, on whichever thread does that.
     *
     * @param isOver whether the action need not be run any more, so that the promise may forget it; asked by any thread
     * @hidden
     */
    protected static void whenSettled(Promise<?> promise, BooleanSupplier isOver, Runnable action) {
        promise.register(new Relay(action, isOver));
    }

    /**
     * A promise of that home that is settled by hand; the action runs, on the calling thread, when it is cancelled.
     *
     * @hidden
     */
    protected static <T extends @Nullable Object> Deferred<T> cancellable(Home home, Runnable ifCancelled) {
        return new Deferred<>(home, ifCancelled);
    }
}
