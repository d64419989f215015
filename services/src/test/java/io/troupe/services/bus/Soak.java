package io.troupe.services.bus;

import java.time.Duration;
import java.util.function.LongConsumer;

/**
 * Repeats a test that looks for what happens rarely: a little in every build, or for a third of
 * {@code -Dsoak.minutes=10} each of the three that there are. Begins with the round {@code -Dsoak.first=17}.
 */
public final class Soak {
    private static final long MINUTES = Long.getLong("soak.minutes", 0);
    private static final long FIRST = Long.getLong("soak.first", 0);
    private static final int TESTS = 3;

    private Soak() {}

    /** Runs so many rounds at least, and says in an error which one it was. */
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
