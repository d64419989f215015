package io.troupe.demo.evaluate;

import java.util.Arrays;

/** A growing list of durations in nanoseconds. */
final class Durations {
    private long[] nanos = new long[64];
    private int count;

    void add(long duration) {
        if (count == nanos.length) {
            nanos = Arrays.copyOf(nanos, 2 * count);
        }
        nanos[count++] = duration;
    }

    int count() {
        return count;
    }

    /** A quantile, in units of {@code unitNanos} nanoseconds. The list must not be empty. */
    double quantile(double share, double unitNanos) {
        double[] sorted =
                Arrays.stream(nanos, 0, count).sorted().asDoubleStream().toArray();
        return SampleStatistics.quantile(sorted, share) / unitNanos;
    }

    /**
     * The mean without the longest hundredth, which garbage collection, compilation or other programs cause; in units
     * of {@code unitNanos} nanoseconds. The list must not be empty.
     */
    double trimmedMean(double unitNanos) {
        int kept = count - count / 100;
        return Arrays.stream(nanos, 0, count).sorted().limit(kept).sum() / unitNanos / kept;
    }
}
