package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.loop.Home;
import java.time.Duration;
import java.util.Objects;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Future;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;

/** Sets the timers of a space: for its actors, and for promises from any thread. */
final class SpaceTimers {
    private final SpaceHome space;
    private final Clock clock;
    private final TimerWheel wheel;
    private final Outside outside;

    SpaceTimers(SpaceHome space, Clock clock, TimerWheel wheel) {
        this.space = space;
        this.clock = clock;
        this.wheel = wheel;
        this.outside = new Outside(space);
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

    /**
     * The delays that threads other than the space's own have set, so that they expire in time even if the space is
     * stalled. They run on one {@link TimerThread} per space, which ends with the space.
     *
     * <p><b>Threads.</b> Any thread. A continuation of {@code toCompletableFuture()} runs on the timer thread: one that
     * blocks delays the others of its space. <b>Cost.</b> Setting and cancelling take time logarithmic in the number of
     * delays.
     */
    private static final class Outside {
        private final SpaceHome space;
        private final Clock realTime = Clock.system(); // that of the executor
        private final Set<Delay> pending = ConcurrentHashMap.newKeySet(); // the thread that removes a delay runs it
        private @Nullable TimerThread executor; // guarded by this
        private volatile boolean closed;

        Outside(SpaceHome space) {
            this.space = space;
        }

        /**
         * Runs the task of an expiry after a delay.
         *
         * @return cancels it
         */
        Runnable schedule(long delayNanos, Expiry expiry) {
            var delay = new Delay(expiry, realTime.nanos() + delayNanos);
            pending.add(delay);
            try {
                Future<?> future = executor().schedule(delay, delayNanos, TimeUnit.NANOSECONDS);
                return () -> {
                    if (pending.remove(delay)) {
                        future.cancel(false);
                    }
                };
            } catch (RejectedExecutionException spaceIsClosed) {
                delay.runIfClosed();
                return () -> {};
            }
        }

        private synchronized TimerThread executor() {
            if (closed) {
                throw new RejectedExecutionException("space " + space + " is closed");
            }
            if (executor == null) {
                executor = new TimerThread(space + "-timers", space.contextClassLoader(), this::runOverdue);
            }
            return executor;
        }

        /** Runs the delays that are over and were not run; see {@link TimerThread}. */
        private void runOverdue() {
            long now = realTime.nanos();
            for (Delay delay : pending) {
                if (delay.deadlineNanos - now <= 0) {
                    delay.run();
                }
            }
        }

        int size() {
            return pending.size();
        }

        /** Called when the space is closed: runs the alternative tasks, and returns the number of pending delays. */
        int close() {
            synchronized (this) {
                closed = true;
                if (executor != null) {
                    executor.shutdownNow();
                }
            }
            int count = 0;
            for (Delay delay : pending) {
                count += delay.runIfClosed() ? 1 : 0;
            }
            return count;
        }

        /** One delay, compared by identity. */
        private final class Delay implements Runnable {
            private final Expiry expiry;
            private final long deadlineNanos;

            Delay(Expiry expiry, long deadlineNanos) {
                this.expiry = expiry;
                this.deadlineNanos = deadlineNanos;
            }

            @Override
            public void run() {
                if (pending.remove(this)) {
                    guard(expiry.task());
                }
            }

            /** Runs the alternative task; false if the delay has expired or was cancelled. */
            boolean runIfClosed() {
                boolean mine = pending.remove(this);
                if (mine) {
                    guard(expiry.ifClosed());
                }
                return mine;
            }

            private void guard(Runnable task) {
                try {
                    task.run();
                } catch (Throwable thrown) {
                    space.reports().error(Trouble.A_DELAY, space, thrown);
                }
            }
        }
    }
}
