package io.troupe.actor;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Schedule;
import io.troupe.actor.time.Timer;
import java.time.Duration;
import java.util.function.BooleanSupplier;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Base class of an actor that needs access to its space, or that is called by its class instead of an interface
 * ({@code class Demo3 extends Actor}).
 *
 * <p><b>Role.</b> Optional: any object can be the implementation of an actor interface. Created by the factory passed
 * to {@link ActorSpace#spawn}; the public methods that return {@code void} or {@link Promise} are its messages.
 *
 * {@snippet :
 * class Heater extends Actor {
 *     private int degrees = 18;
 *
 *     @Override
 *     protected void started() {
 *         every(Duration.ofMinutes(1), () -> degrees++);
 *     }
 *
 *     public void set(int newDegrees) {
 *         degrees = newDegrees;
 *     }
 *
 *     public Promise<Integer> degrees() {
 *         return Promise.of(degrees);
 *     }
 * }
 *
 * Heater heater = space.spawn(Heater.class, Heater::new); // a proxy
 * heater.set(20); // a message
 * }
 *
 * <p><b>Threads.</b> The space's thread; calling these methods from another thread throws
 * {@link IllegalStateException}.
 *
 * <p><b>Source.</b> Paper, Figures 17 and 20.
 */
public abstract class Actor {
    private final SpaceTimers.Keyed keyed = new SpaceTimers.Keyed();
    private @Nullable ActorCell cell;

    protected Actor() {}

    final void join(ActorCell mine) {
        keyed.cancelAll(); // those of the previous incarnation, if the factory returns the same object again
        if (cell != null && cell != mine) {
            throw new ActorException("the factory of " + mine + " answered an object that is the actor " + cell
                    + " already, expected one of its own");
        }
        cell = mine;
    }

    /**
     * The proxy of this actor: pass it to others, and call it to send this actor a message that is processed in a later
     * turn. (A call on {@code this} runs immediately.)
     *
     * <p><b>Order.</b> The message is queued behind those that this actor has sent itself before. The order relative to
     * messages of other senders is not defined.
     */
    @SuppressWarnings("unchecked") // the caller names the type with which it spawned this actor
    protected final <A> A self() {
        return (A) java.util.Objects.requireNonNull(cell("self()").proxy());
    }

    /** The space of this actor. */
    protected final ActorSpace space() {
        return cell("space()").space().facade();
    }

    /** Called before the first message. */
    protected void started() {}

    /**
     * Called after the last message, but not if the constructor threw. Requests that are still open after it are
     * rejected.
     */
    protected void stopped() {}

    /**
     * Stops this actor after the current message. Queued one-way messages become dead letters. Queued requests are
     * rejected, and so are requests that have begun and are not yet answered.
     */
    protected final void stop() {
        var mine = cell("stop()");
        mine.space().dispatcher.afterTurn(mine::stop);
    }

    /**
     * Holds this actor's calls back, from the next one until {@link #release}: for an actor that first has to connect.
     * Timers, listeners and callbacks run meanwhile. The calls wait in the order in which they were sent, including
     * those that this actor sends to itself, and occupy their places in a bounded mailbox.
     *
     * {@snippet :
     * @Override
     * protected void started() {
     *     hold();
     *     modem.connect().then(line -> {
     *         connected = line;
     *         release(); // now the calls that came meanwhile are served, in their order
     *     });
     * }
     * }
     *
     * <p>Not counted: one {@link #release} suffices. A restart ends it, and so does {@link #started()} that throws. If
     * the actor stops, the calls are rejected as at every end of an actor; {@link ActorSpace#stop} does not wait for
     * them.
     */
    protected final void hold() {
        cell("hold()").hold();
    }

    /** Ends {@link #hold}: the calls that were held back are served before later ones. No effect without it. */
    protected final void release() {
        cell("release()").release();
    }

    final SpaceTimers.Keyed keyedTimers() {
        return keyed;
    }

    /**
     * Runs a task once after a delay, unless this actor has stopped. A space with thousands of timers wakes for several
     * of them at once, up to 2 ms late.
     */
    protected final Timer after(Duration delay, Runnable task) {
        return cell("after(..)").setTimer(delay, Duration.ZERO, Schedule.FIXED_RATE, task);
    }

    /**
     * Runs a task periodically, first after one period, until this actor has stopped; with the schedule
     * {@link Schedule#FIXED_RATE}.
     */
    protected final Timer every(Duration period, Runnable task) {
        return every(period, Schedule.FIXED_RATE, task);
    }

    /**
     * Runs a task periodically, first after one period, until this actor has stopped.
     *
     * @param schedule the next run after one that was late or took long
     */
    protected final Timer every(Duration period, Schedule schedule, Runnable task) {
        checkPeriod(period);
        return cell("every(..)").setTimer(period, period, schedule, task);
    }

    /**
     * Runs a task once after a delay, replacing the timer with that key: a previous timer that has not run yet is
     * cancelled, even if it is already due. The timer is removed when it has run, and when this actor stops or
     * restarts.
     *
     * @param key any object, compared by {@code equals}; private to this actor
     */
    protected final Timer after(Object key, Duration delay, Runnable task) {
        return keyed.set(cell("after(..)"), key, delay, Duration.ZERO, Schedule.FIXED_RATE, task);
    }

    /**
     * Like {@link #every(Duration, Runnable)}, replacing the timer with that key; see {@link #after(Object, Duration,
     * Runnable)}.
     */
    protected final Timer every(Object key, Duration period, Runnable task) {
        return every(key, period, Schedule.FIXED_RATE, task);
    }

    /**
     * Like {@link #every(Duration, Schedule, Runnable)}, replacing the timer with that key; see {@link #after(Object,
     * Duration, Runnable)}.
     */
    protected final Timer every(Object key, Duration period, Schedule schedule, Runnable task) {
        checkPeriod(period);
        return keyed.set(cell("every(..)"), key, period, period, schedule, task);
    }

    /** Cancels the timer with that key; false if there is none, or if it has run or was cancelled. */
    protected final boolean cancelTimer(Object key) {
        cell("cancelTimer(..)");
        return keyed.cancel(key);
    }

    /** True if the timer with that key is set: it has not run for the last time and was not cancelled. */
    protected final boolean isTimerActive(Object key) {
        cell("isTimerActive(..)");
        return keyed.isActive(key);
    }

    /**
     * The {@code while} loop of the paper, one turn of the space per round: see
     * {@link ActorSpace#repeatWhile(BooleanSupplier, Runnable)}.
     */
    protected final Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Runnable body) {
        return space().repeatWhile(condition, body);
    }

    /** A loop whose next round begins when the promise of the previous round is fulfilled. */
    protected final Promise<@Nullable Void> repeatWhile(
            BooleanSupplier condition, Supplier<? extends Promise<?>> body) {
        return space().repeatWhile(condition, body);
    }

    private static void checkPeriod(Duration period) {
        if (period.isZero() || period.isNegative()) {
            throw new IllegalArgumentException("the period is " + period + ", expected more than zero");
        }
    }

    private ActorCell cell(String call) {
        ActorCell mine = cell;
        if (mine == null) {
            throw new IllegalStateException(
                    call + " of " + getClass().getName()
                            + " is for a spawned actor itself, from started() on: not for its constructor, and not through its proxy");
        }
        mine.space().checkCurrent(call);
        return mine;
    }
}
