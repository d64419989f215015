package io.troupe.bus;

import java.time.Duration;
import java.util.function.LongConsumer;

/**
 * Repeats a test that looks for rare failures: a few rounds in every build, or for a share of {@code -Dsoak.minutes=10}
 * for each of the soak tests. Starts with the round {@code -Dsoak.first=17}.
 */
public final class Soak {
    private static final long MINUTES = Long.getLong("soak.minutes", 0);
    private static final long FIRST = Long.getLong("soak.first", 0);
    private static final int TESTS = 4;

    private Soak() {}

    /** Runs at least this many rounds; an error names the round in which it occurred. */
    public static void rounds(int atLeast, LongConsumer round) {
        long end =
                System.nanoTime() + Duration.ofMinutes(MINUTES).dividedBy(TESTS).toNanos();
        for (long i = FIRST; i < FIRST + atLeast || System.nanoTime() < end; i++) {
            try {
                round.accept(i);
            } catch (AssertionError | RuntimeException failure) {
                throw new AssertionError("in round " + i + " (-Dsoak.first=" + i + ")", failure);
            }
        }
    }
}
