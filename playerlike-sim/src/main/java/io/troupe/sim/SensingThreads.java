package io.troupe.sim;

import io.troupe.actor.Clock;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Divides the robots among threads. Each thread has a fixed range of them; the calling thread has the first range.
 * Where waking the other threads takes longer than they save, the calling thread does all the work
 * ({@link MeasuredChoice}).
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
    private final Choice choice;
    private final Clock clock = Clock.system();
    private final Object lock = new Object();
    private final @Nullable Throwable[] failures;
    private final List<Thread> helpers = new ArrayList<>();
    private long round;
    private int atWork;
    private boolean closed;

    SensingThreads(String name, int rangeCount, int robotCount, Choice choice, Ranges ranges) {
        this.choice = choice;
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
        if (rangeCount == 1) {
            work(0);
        } else {
            long startNanos = clock.nanos();
            if (choice.isTogether() && begin()) {
                work(0);
                awaitHelpers();
            } else {
                for (int range = 0; range < rangeCount; range++) {
                    work(range);
                }
            }
            choice.took(clock.nanos() - startNanos);
        }
        for (int range = 0; range < rangeCount; range++) {
            Throwable failure = failures[range];
            if (failure != null) {
                failures[range] = null;
                throw failure instanceof RuntimeException thrown ? thrown : new IllegalStateException(failure);
            }
        }
    }

    /** Starts a round of the helper threads; false if they have ended. */
    private boolean begin() {
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
                    throw new IllegalStateException("no code interrupts a sensing thread", e);
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

    /** Chooses between all threads and the calling thread alone. It changes only the speed. */
    interface Choice {
        /** Uses all threads, however long they take. */
        Choice ALL = new Choice() {
            @Override
            public boolean isTogether() {
                return true;
            }

            @Override
            public void took(long nanos) {
                // always the same
            }
        };

        /** True if the next round should be run by all threads. */
        boolean isTogether();

        /** How long the round took. */
        void took(long nanos);
    }

    /**
     * Chooses by the times that both ways take.
     *
     * <p>A trial runs a few rounds each way and compares the medians, so that a pause of one round does not matter. The
     * threads have to be clearly faster. The winner is used until the next trial; trials become rarer as long as they
     * end in the same way.
     */
    static final class MeasuredChoice implements Choice {
        /** Rounds of a trial, each way. */
        static final int TRIAL_ROUNDS = 9;

        static final int LEAST_PAUSE_ROUNDS = 64;
        static final int MOST_PAUSE_ROUNDS = 8192;
        /** The threads are used if they take less than this part of the time of one thread. */
        private static final double CLEARLY_FASTER = 0.9;

        private final long[] togetherNanos = new long[TRIAL_ROUNDS];
        private final long[] aloneNanos = new long[TRIAL_ROUNDS];
        private boolean winner = true;
        private int trialRound; // from 0; both ways take turns
        private int pauseRounds = LEAST_PAUSE_ROUNDS;
        private int untilTrial;

        @Override
        public boolean isTogether() {
            return untilTrial > 0 ? winner : trialRound % 2 == 0;
        }

        @Override
        public void took(long nanos) {
            if (untilTrial > 0) {
                untilTrial--;
                return;
            }
            (isTogether() ? togetherNanos : aloneNanos)[trialRound / 2] = nanos;
            trialRound++;
            if (trialRound == 2 * TRIAL_ROUNDS) {
                boolean faster = median(togetherNanos) < CLEARLY_FASTER * median(aloneNanos);
                pauseRounds = faster == winner ? Math.min(2 * pauseRounds, MOST_PAUSE_ROUNDS) : LEAST_PAUSE_ROUNDS;
                winner = faster;
                untilTrial = pauseRounds;
                trialRound = 0;
            }
        }

        private static long median(long[] nanos) {
            Arrays.sort(nanos);
            return nanos[TRIAL_ROUNDS / 2];
        }
    }
}
