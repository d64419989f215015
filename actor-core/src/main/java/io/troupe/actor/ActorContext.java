package io.troupe.actor;

import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Objects;
import java.util.function.BooleanSupplier;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * What an actor may do beside answering: its space, its end, its timers.
 *
 * <p><b>Role.</b> An actor gets its own by {@link Actor#context()}. These methods are here and not in {@link Actor}, so
 * that messages may have their names: a motor has a {@code stop()}, a lock a {@code release()}.
 *
 * {@snippet :
 * interface Motor {
 *     void turn(double speedRadps);
 *
 *     void stop();
 * }
 *
 * class GearMotor extends Actor implements Motor {
 *     private double speedRadps;
 *
 *     @Override
 *     public void turn(double newSpeedRadps) {
 *         speedRadps = newSpeedRadps;
 *         context().after("silence", Duration.ofSeconds(3), this::stop); // unless the next command comes first
 *     }
 *
 *     @Override
 *     public void stop() {
 *         speedRadps = 0;
 *         context().cancelTimer("silence");
 *     }
 * }
 * }
 *
 * <p><b>Threads.</b> The space's thread; a call from another thread throws {@link IllegalStateException}.
 *
 * <p>After the actor has stopped, {@link #space} still answers, timers that are set count as cancelled, and the other
 * methods have no effect. The same holds for the context of an instance that a restart has replaced.
 *
 * <p><b>Cost.</b> One object per actor, which {@link Actor#context()} returns each time.
 */
public final class ActorContext {
    private Incarnation life;
    private @Nullable KeyedTimers keyed; // most actors have none

    ActorContext(Incarnation life) {
        this.life = life;
    }

    /**
     * Begins with no keyed timers: those of the previous incarnation, if the same object is started again, have ended.
     */
    void begin(Incarnation newLife) {
        life = newLife;
        keyed = null;
    }

    ActorCell cell() {
        return life.cell();
    }

    /** The space of this actor. */
    public ActorSpace space() {
        return cell("space()").space().facade();
    }

    /**
     * Stops this actor after the current message. Queued one-way messages become dead letters. Queued requests are
     * rejected, and so are requests that have begun and are not yet answered.
     */
    public void stop() {
        ActorCell cell = cell("stop()");
        if (!life.isOver()) {
            cell.space().dispatcher.afterTurn(cell::stop);
        }
    }

    /**
     * Holds this actor's calls back, from the next one until {@link #release}: for an actor that first has to connect.
     * Timers, listeners and callbacks run meanwhile. The calls wait in the order in which they were sent, including
     * those that this actor sends to itself, and occupy their places in a bounded mailbox.
     *
     * {@snippet :
     * @Override
     * protected void started() {
     *     context().hold();
     *     modem.connect().then(line -> {
     *         connected = line;
     *         context().release(); // now the calls that came meanwhile are served, in their order
     *     });
     * }
     * }
     *
     * <p>Not counted: one {@link #release} suffices. A restart ends it, and so does {@link Actor#started()} that
     * throws. If the actor stops, the calls are rejected, as whenever an actor stops; {@link ActorSpace#stop} does not
     * wait for them.
     */
    public void hold() {
        ActorCell cell = cell("hold()");
        if (!life.isOver()) {
            cell.hold();
        }
    }

    /** Ends {@link #hold}: the calls that were held back are served before later ones. No effect without it. */
    public void release() {
        ActorCell cell = cell("release()");
        if (!life.isOver()) {
            cell.release();
        }
    }

    /**
     * Runs a task once after a delay, unless this actor has stopped. A space with thousands of timers wakes for several
     * of them at once, up to 2 ms late.
     */
    public Timer after(Duration delay, Runnable task) {
        return cell("after(..)").space().timers().set(life, delay, Duration.ZERO, Schedule.FIXED_RATE, task);
    }

    /**
     * Runs a task periodically, first after one period, until this actor has stopped; with the schedule
     * {@link Schedule#FIXED_RATE}.
     */
    public Timer every(Duration period, Runnable task) {
        return every(period, Schedule.FIXED_RATE, task);
    }

    /**
     * Runs a task periodically, first after one period, until this actor has stopped.
     *
     * @param schedule the next run after one that was late or took long
     */
    public Timer every(Duration period, Schedule schedule, Runnable task) {
        checkPeriod(period);
        return cell("every(..)").space().timers().set(life, period, period, schedule, task);
    }

    /**
     * Runs a task once after a delay, replacing the timer with that key: a previous timer that has not run yet is
     * cancelled, even if it is already due. The timer is removed when it has run, and when this actor stops or
     * restarts.
     *
     * @param key any object, compared by {@code equals}; private to this actor
     */
    public Timer after(Object key, Duration delay, Runnable task) {
        cell("after(..)");
        return keyed(key).set(life, key, delay, Duration.ZERO, Schedule.FIXED_RATE, task);
    }

    /**
     * Like {@link #every(Duration, Runnable)}, replacing the timer with that key; see {@link #after(Object, Duration,
     * Runnable)}.
     */
    public Timer every(Object key, Duration period, Runnable task) {
        return every(key, period, Schedule.FIXED_RATE, task);
    }

    /**
     * Like {@link #every(Duration, Schedule, Runnable)}, replacing the timer with that key; see {@link #after(Object,
     * Duration, Runnable)}.
     */
    public Timer every(Object key, Duration period, Schedule schedule, Runnable task) {
        checkPeriod(period);
        cell("every(..)");
        return keyed(key).set(life, key, period, period, schedule, task);
    }

    /** Cancels the timer with that key; false if there is none, or if it has run or was cancelled. */
    public boolean cancelTimer(Object key) {
        cell("cancelTimer(..)");
        return keyed(key).cancel(key);
    }

    /** True if the timer with that key is set: it has not run for the last time and was not cancelled. */
    public boolean isTimerActive(Object key) {
        cell("isTimerActive(..)");
        return keyed(key).isActive(key);
    }

    /**
     * The {@code while} loop of the paper, one turn of the space per round: see
     * {@link ActorSpace#repeatWhile(BooleanSupplier, Runnable)}.
     */
    public Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Runnable body) {
        return cell("repeatWhile(..)").space().facade().repeatWhile(condition, body);
    }

    /** A loop whose next round begins when the promise of the previous round is fulfilled. */
    public Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Supplier<? extends Promise<?>> body) {
        return cell("repeatWhile(..)").space().facade().repeatWhile(condition, body);
    }

    private static void checkPeriod(Duration period) {
        if (period.isZero() || period.isNegative()) {
            throw new IllegalArgumentException("the period is " + period + ", expected more than zero");
        }
    }

    /** The cell of this actor, for a call on its thread. */
    private ActorCell cell(String call) {
        ActorCell cell = life.cell();
        if (!cell.space().isCurrent()) {
            cell.space().checkCurrent("context()." + call + " of " + cell);
        }
        return cell;
    }

    private KeyedTimers keyed(Object key) {
        Objects.requireNonNull(key, "key");
        if (keyed == null) {
            keyed = new KeyedTimers();
        }
        return keyed;
    }

    /**
     * The number of stored timers with keys: those that are waiting, and at most as many that were cancelled by their
     * handle.
     */
    int keyedTimers() {
        return keyed == null ? 0 : keyed.timers.size();
    }

    /**
     * The timers with keys: at most one per key. On the space's thread.
     *
     * <p><b>Cost.</b> Amortized constant time: timers that were cancelled by their handle are removed whenever the map
     * has doubled.
     */
    private static final class KeyedTimers {
        private static final int SMALL = 16;

        private final Map<Object, Timer> timers = new HashMap<>();
        private int sweepAt = SMALL;

        Timer set(Incarnation life, Object key, Duration delay, Duration period, Schedule schedule, Runnable task) {
            Objects.requireNonNull(task, "task");
            boolean once = period.isZero();
            Timer timer = life.cell().space().timers().set(life, delay, period, schedule, () -> {
                if (once) {
                    timers.remove(key); // first, because the task may set the key again
                }
                task.run();
            });
            Timer before = timers.put(key, timer);
            if (before != null) {
                before.cancel();
            } else if (timers.size() >= sweepAt) {
                timers.values().removeIf(each -> !each.isWaiting());
                sweepAt = Math.max(SMALL, 2 * timers.size());
            }
            return timer;
        }

        boolean cancel(Object key) {
            Timer timer = timers.remove(key);
            return timer != null && timer.cancel();
        }

        boolean isActive(Object key) {
            Timer timer = timers.get(key);
            return timer != null && timer.isWaiting();
        }
    }
}
