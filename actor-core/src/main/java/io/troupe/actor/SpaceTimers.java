package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import java.time.Duration;
import java.util.Objects;

/** Sets the timers of a space: for its actors, and for promises from any thread. */
final class SpaceTimers {
    private final SpaceHome space;
    private final Clock clock;
    private final TimerWheel wheel;
    private final OutsideTimers outside;

    SpaceTimers(SpaceHome space, Clock clock, TimerWheel wheel) {
        this.space = space;
        this.clock = clock;
        this.wheel = wheel;
        this.outside = new OutsideTimers(space);
    }

    /** Sets a timer that ends with an incarnation of an actor, at once if that is over; on the space's thread. */
    Timer set(Incarnation life, Duration delay, Duration period, Schedule schedule, Runnable task) {
        Objects.requireNonNull(delay, "delay");
        Objects.requireNonNull(period, "period");
        Objects.requireNonNull(task, "task");
        Timer timer = wheel.set(() -> life.run("a timer", task), Home.nanosOf(delay), Home.nanosOf(period), schedule);
        if (life.isOver()) {
            timer.cancel(); // else one with a period would stay for ever
        } else {
            life.own(timer);
        }
        return timer;
    }

    /** See {@link SpaceHome#schedule}. */
    Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed) {
        var expiry = new Expiry(task, ifClosed);
        if (!space.isCurrent()) {
            return clock.runsByItself() // otherwise time passes only when the clock is moved, which wakes the space
                    ? outside.schedule(delayNanos, expiry)
                    : scheduleRemotely(delayNanos, expiry);
        }
        if (space.hasEnded()) {
            ifClosed.run(); // the timers are no longer checked
            return () -> {};
        }
        Timer timer = wheel.set(expiry, delayNanos, 0);
        return () -> onThread(timer::cancel);
    }

    private Runnable scheduleRemotely(long delayNanos, Expiry expiry) {
        var pending = new Timer[1]; // both accessed on the space's thread only
        var withdrawn = new boolean[1];
        long deadline = clock.nanos() + delayNanos;
        space.enqueueMessage(new Entry(
                () -> {
                    if (!withdrawn[0]) {
                        pending[0] = wheel.set(expiry, deadline - clock.nanos(), 0);
                    }
                },
                expiry.ifClosed()));
        return () -> onThread(() -> {
            withdrawn[0] = true;
            if (pending[0] != null) {
                pending[0].cancel();
            }
        });
    }

    /** The number of timers, including those set by other threads. */
    int size() {
        return wheel.size() + outside.size();
    }

    /** Called when the space is closed: ends the delays set by other threads, and returns their number. */
    int closeOutside() {
        return outside.close();
    }

    private void onThread(Runnable task) {
        if (space.isCurrent()) {
            task.run();
        } else {
            space.enqueueMessage(new Entry(task, () -> {}));
        }
    }

    /** The task of a timer, and the task that runs instead if the space is closed first. */
    record Expiry(Runnable task, Runnable ifClosed) implements Runnable {
        @Override
        public void run() {
            task.run();
        }
    }
}
