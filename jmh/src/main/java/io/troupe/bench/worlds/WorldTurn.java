package io.troupe.bench.worlds;

import com.sun.management.ThreadMXBean;
import java.lang.management.ManagementFactory;

/**
 * The result of one turn of a contender.
 *
 * @param factor simulated seconds per second of wall clock
 * @param bytesPerStep the bytes that all threads of its JVM allocated, for sensing and driving too, per physics step
 */
record WorldTurn(double factor, double bytesPerStep) {
    /** In a field, because looking it up allocates. */
    private static final ThreadMXBean THREADS = ManagementFactory.getPlatformMXBean(ThreadMXBean.class);

    /** Calls grow until this part of the turn is over: so a call has little overhead, and a turn has many calls. */
    private static final int GROWTH = 16;

    /** The number of calls in a turn of the expected length. */
    private static final int CALLS = 4;

    private static final int MOST_AT_ONCE = 1_000;

    /**
     * Runs the world for about {@code budgetNanos}, at least for one interval.
     *
     * @param expectedFactor the factor of an earlier turn, 0 if there was none
     */
    static WorldTurn run(BenchWorld world, long budgetNanos, double expectedFactor) {
        long bytes = THREADS.getTotalThreadAllocatedBytes();
        long start = System.nanoTime();
        long intervals = 0;
        long spent;
        double expectedIntervals = expectedFactor * budgetNanos / (TiledScene.INTERVAL_MILLIS * 1e6);
        int atOnce = (int) Math.clamp(expectedIntervals / CALLS, 1, MOST_AT_ONCE);
        do {
            world.advance(atOnce);
            intervals += atOnce;
            spent = System.nanoTime() - start;
            if (spent < budgetNanos / GROWTH) {
                atOnce = Math.min(2 * atOnce, MOST_AT_ONCE);
            }
        } while (spent < budgetNanos);
        bytes = THREADS.getTotalThreadAllocatedBytes() - bytes;
        double simulatedNanos = intervals * TiledScene.INTERVAL_MILLIS * 1e6;
        return new WorldTurn(simulatedNanos / spent, (double) bytes / (intervals * TiledScene.STEPS_PER_INTERVAL));
    }

    /** This turn as a line of the pipe. */
    String line() {
        return factor + " " + bytesPerStep;
    }

    static WorldTurn parse(String line) {
        String[] parts = line.split(" ");
        if (parts.length != 2) {
            throw new IllegalArgumentException("a turn is \"" + line + "\", expected a factor and bytes per step");
        }
        return new WorldTurn(Double.parseDouble(parts[0]), Double.parseDouble(parts[1]));
    }
}
