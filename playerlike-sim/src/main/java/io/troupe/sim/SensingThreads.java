package io.troupe.sim;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Divides the robots among threads. Each thread has a fixed range of them; the calling thread has the first range.
 *
 * <p><b>Threads.</b> Daemon threads, started by the constructor and ended by {@link #close}. {@code close} may be
 * called from any thread and lets a current run finish. All other methods belong to one thread.
 *
 * <p><b>Errors.</b> {@link #run} throws the exception of a range; if several failed, that of the lowest range.
 */
final class SensingThreads implements AutoCloseable {
    /** The work for the robots from one index (inclusive) to another (exclusive). */
    @FunctionalInterface
    interface Ranges {
        /** @param range number of the range, from 0 */
        void run(int range, int fromRobot, int toRobot);
    }

    private final int robotCount;
    private final int rangeCount;
    private final Ranges ranges;
    private final Object lock = new Object();
    private final @Nullable Throwable[] failures;
    private final List<Thread> helpers = new ArrayList<>();
    private long round;
    private int atWork;
    private boolean closed;

    SensingThreads(String name, int rangeCount, int robotCount, Ranges ranges) {
        this.robotCount = robotCount;
        this.rangeCount = rangeCount;
        this.ranges = ranges;
        failures = new Throwable[rangeCount];
        for (int i = 1; i < rangeCount; i++) {
            int range = i;
            helpers.add(Thread.ofPlatform()
                    .name("sensing-" + name + "-" + range)
                    .daemon()
                    .start(() -> help(range)));
        }
    }

    /** Runs all ranges and returns when all are done. */
    void run() {
        if (!begin()) {
            for (int range = 0; range < rangeCount; range++) {
                work(range);
            }
        } else {
            work(0);
            awaitHelpers();
        }
        for (int range = 0; range < rangeCount; range++) {
            Throwable failure = failures[range];
            if (failure != null) {
                failures[range] = null;
                throw failure instanceof RuntimeException thrown ? thrown : new IllegalStateException(failure);
            }
        }
    }

    /** Starts a round of the helper threads; false if there are none. */
    private boolean begin() {
        if (rangeCount == 1) {
            return false;
        }
        synchronized (lock) {
            if (closed) {
                return false;
            }
            round++;
            atWork = rangeCount - 1;
            lock.notifyAll();
            return true;
        }
    }

    private void work(int range) {
        try {
            ranges.run(range, first(range), first(range + 1));
        } catch (RuntimeException | Error thrown) {
            failures[range] = thrown;
        }
    }

    private int first(int range) {
        return (int) ((long) robotCount * range / rangeCount);
    }

    private void awaitHelpers() {
        boolean interrupted = false;
        synchronized (lock) {
            while (atWork > 0) {
                try {
                    lock.wait();
                } catch (InterruptedException e) {
                    interrupted = true; // the helpers finish soon, and the world must not change before
                }
            }
        }
        if (interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    private void help(int range) {
        for (long done = 0; awaitRound(done); done++) {
            work(range);
            synchronized (lock) {
                atWork--;
                lock.notifyAll();
            }
        }
    }

    /** Waits for the round after the given number of rounds; false when closed. */
    private boolean awaitRound(long done) {
        synchronized (lock) {
            while (round == done && !closed) {
                try {
                    lock.wait();
                } catch (InterruptedException e) {
                    throw new IllegalStateException("nobody interrupts a sensing thread", e);
                }
            }
            return round > done;
        }
    }

    /** The threads other than the caller's. */
    List<Thread> helpers() {
        return List.copyOf(helpers);
    }

    @Override
    public void close() {
        synchronized (lock) {
            closed = true;
            lock.notifyAll();
        }
    }
}
