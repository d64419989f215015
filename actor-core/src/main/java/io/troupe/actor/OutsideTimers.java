package io.troupe.actor;

import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Future;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;

/**
 * The delays that threads other than the space's own have set, so that they expire in time even if the space is
 * stalled. They run on one daemon thread per space. It is started on demand and ends {@value #IDLE_SECONDS} seconds
 * after the last delay, or with the space.
 *
 * <p><b>Threads.</b> Any thread. A continuation of {@code toCompletableFuture()} runs on the timer thread: one that
 * blocks delays the others of its space. <b>Cost.</b> Setting and cancelling take time logarithmic in the number of
 * delays.
 */
final class OutsideTimers {
    private static final long IDLE_SECONDS = 10;

    private final SpaceHome space;
    private final Set<Delay> pending = ConcurrentHashMap.newKeySet(); // the thread that removes a delay runs it
    private @Nullable ScheduledThreadPoolExecutor executor; // guarded by this
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
        var delay = new Delay(expiry);
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

    private synchronized ScheduledThreadPoolExecutor executor() {
        if (closed) {
            throw new RejectedExecutionException("space " + space + " is closed");
        }
        if (executor == null) {
            executor = new ScheduledThreadPoolExecutor(
                    1,
                    Thread.ofPlatform()
                            .daemon()
                            .inheritInheritableThreadLocals(false)
                            .name(space + "-timers")
                            .factory());
            executor.setRemoveOnCancelPolicy(true); // a settled promise must not be retained here
            executor.setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
            executor.allowCoreThreadTimeOut(true);
        }
        return executor;
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

        Delay(SpaceTimers.Expiry expiry) {
            this.expiry = expiry;
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
                space.reports().error("a delay that was asked of space", space, thrown, null);
            }
        }
    }
}
