package io.troupe.demo.evaluate;

import java.util.Arrays;

/** Many durations in nanoseconds. */
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

    /** The duration below which a share of all lies, in units of so many nanoseconds; there must be one. */
    double quantile(double share, double unitNanos) {
        double[] sorted =
                Arrays.stream(nanos, 0, count).sorted().asDoubleStream().toArray();
        return Spread.quantile(sorted, share) / unitNanos;
    }

    /**
     * The mean of the shorter ones, without the longest hundredth, which the collector, the compiler or another program
     * has made so; in units of so many nanoseconds. There must be one.
     */
    double trimmedMean(double unitNanos) {
        int kept = count - count / 100;
        return Arrays.stream(nanos, 0, count).sorted().limit(kept).sum() / unitNanos / kept;
    }
}
