package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Future;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;

/**
 * The delays that threads other than the space's own have set, so that they expire in time even if the space is
 * stalled. They run on one {@link TimerThread} per space, which ends with the space.
 *
 * <p><b>Threads.</b> Any thread. A continuation of {@code toCompletableFuture()} runs on the timer thread: one that
 * blocks delays the others of its space. <b>Cost.</b> Setting and cancelling take time logarithmic in the number of
 * delays.
 */
final class OutsideTimers {
    private final SpaceHome space;
    private final Clock realTime = Clock.system(); // that of the executor
    private final Set<Delay> pending = ConcurrentHashMap.newKeySet(); // the thread that removes a delay runs it
    private @Nullable TimerThread executor; // guarded by this
    private volatile boolean closed;

    OutsideTimers(SpaceHome space) {
        this.space = space;
    }

    /**
     * Runs the task of an expiry after a delay.
     *
     * @return cancels it
     */
    Runnable schedule(long delayNanos, SpaceTimers.Expiry expiry) {
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
        private final SpaceTimers.Expiry expiry;
        private final long deadlineNanos;

        Delay(SpaceTimers.Expiry expiry, long deadlineNanos) {
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
