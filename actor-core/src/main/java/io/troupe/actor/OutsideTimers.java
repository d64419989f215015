package io.troupe.actor;

import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Future;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;

/**
 * Delays that other threads than a space's own have asked of it, so that they end in time even if the space does not
 * serve. They run on one daemon thread for each space, which is started when there are some and ends
 * {@value #IDLE_SECONDS} seconds after the last one, or with the space.
 *
 * <p><b>Threads.</b> Any thread. A continuation of {@code toCompletableFuture()} runs on the thread of the timers: one
 * that blocks delays the others of its space. <b>Cost.</b> Setting and taking back take time in the logarithm of the
 * number of delays.
 */
final class OutsideTimers {
    private static final long IDLE_SECONDS = 10;

    private final SpaceHome space;
    private final Set<Delay> pending = ConcurrentHashMap.newKeySet(); // whoever removes a delay deals with it
    private @Nullable ScheduledThreadPoolExecutor executor; // guarded by this
    private volatile boolean closed;

    OutsideTimers(SpaceHome space) {
        this.space = space;
    }

    /**
     * Runs the task of an expiry after a delay.
     *
     * @return takes it back
     */
    Runnable schedule(long delayNanos, Expiry expiry) {
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
            executor.setRemoveOnCancelPolicy(true); // a promise that is settled keeps nothing here
            executor.setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
            executor.allowCoreThreadTimeOut(true);
        }
        return executor;
    }

    int size() {
        return pending.size();
    }

    /** The space is closed: runs what was to be done in that case; answers how many delays were not over. */
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

    /** One delay; its identity counts. */
    private final class Delay implements Runnable {
        private final Expiry expiry;

        Delay(Expiry expiry) {
            this.expiry = expiry;
        }

        @Override
        public void run() {
            if (pending.remove(this)) {
                guard(expiry.task());
            }
        }

        /** False if it is over, or was taken back. */
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
