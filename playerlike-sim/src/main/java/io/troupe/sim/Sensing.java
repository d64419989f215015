package io.troupe.sim;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Splits robots among threads: each has a fixed range of them, the caller's own the first.
 *
 * <p><b>Threads.</b> Daemon threads, started at once, ended by {@link #close}, which may come from any thread and lets
 * a run that is under way finish; all others belong to one thread.
 *
 * <p><b>Errors.</b> What a range throws is thrown by {@link #run}; of several, that of the lowest range.
 */
final class Sensing implements AutoCloseable {
    /** Does something for the robots from one index to before another. */
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

    Sensing(String name, int rangeCount, int robotCount, Ranges ranges) {
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

    /** Does all ranges and returns when all are done. */
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

    /** Whether there are helpers, who then begin too. */
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
                    interrupted = true; // they are about to finish, and nothing may change meanwhile
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

    /** Whether there is a round after so many, once it begins; false when closed. */
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

    /** The threads besides the caller's. */
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
