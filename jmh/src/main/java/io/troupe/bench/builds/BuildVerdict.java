package io.troupe.bench.builds;

import io.troupe.tools.SampleStatistics;
import java.util.Arrays;
import java.util.List;
import java.util.function.ToDoubleFunction;

/**
 * Whether a figure of this build is larger than that of the older build, beyond what this build differs from itself.
 *
 * <p><b>Role.</b> A start is three new JVMs that take turns in rounds: one of the build before and two of this build.
 * Each start gives two numbers, both medians of its rounds: the <i>change</i>, this build (the geometric mean of its
 * two JVMs) divided by the build before, and the <i>difference of this build from itself</i>, one of its JVMs divided
 * by the other one. What a JVM compiles differs from start to start and not from round to round, so the starts are the
 * sample. Of both numbers there is an interval that contains the true median, with at least {@link #WANTED} confidence
 * if there are enough starts. The interval supposes nothing about the distribution. The <i>noise</i> is the distance of
 * the interval of this build and itself from 1, in the direction where it reaches further, and at least
 * {@link #LEAST_NOISE}. This build has more only if the whole interval of the change is above the noise, and less only
 * if all of it is below.
 *
 * <p><b>Errors.</b> If the builds are equal, the three JVMs of a start are exchangeable. With fewer than eight starts,
 * "more" requires that the JVM of the build before has the least of the three in each start. So its probability is at
 * most 1/3 to the power of the number of starts, whatever the distribution. With eight and more, one start or more may
 * be disturbed; simulated equal builds have "more" in fewer than 1 of 1,000 rows.
 *
 * @param change this build divided by the one before
 * @param itself this build divided by itself
 * @param noise 0.05 if only changes by more than 5 % count
 */
record BuildVerdict(Interval change, Interval itself, double noise, Kind kind) {
    /** The confidence of an interval, if there are five starts or more. */
    static final double WANTED = 0.9;
    /** Smaller changes are never reported. */
    static final double LEAST_NOISE = 0.02;
    /** With fewer starts there is no noise to speak of, and no verdict. */
    static final int LEAST_STARTS = 3;

    /** The result. */
    enum Kind {
        MORE,
        LESS,
        NO_DIFFERENCE,
        TOO_FEW_STARTS
    }

    /** What the three JVMs gave in one round. */
    record Round<T>(T before, T now, T again) {}

    /** An interval of ratios that contains their true median with this confidence. */
    record Interval(double low, double median, double high, double confidence) {
        /** The interval of a sample's logarithms: from one of the lowest values to one of the highest. */
        static Interval ofMedian(double[] logarithms) {
            double[] sorted = logarithms.clone();
            Arrays.sort(sorted);
            int rank = rank(sorted.length);
            return new Interval(
                    Math.exp(sorted[rank - 1]),
                    Math.exp(SampleStatistics.quantile(sorted, 0.5)),
                    Math.exp(sorted[sorted.length - rank]),
                    confidence(sorted.length, rank));
        }

        /** The interval goes from this value, counted from the lowest, to that value counted from the highest. */
        static int rank(int count) {
            int rank = 1;
            while (rank < (count + 1) / 2 && confidence(count, rank + 1) >= WANTED) {
                rank++;
            }
            return rank;
        }

        /** The probability that neither fewer than {@code rank} values are below the median nor fewer above it. */
        static double confidence(int count, int rank) {
            double ways = 1;
            double outside = 0;
            for (int below = 0; below < rank; below++) {
                outside += ways;
                ways = ways * (count - below) / (below + 1);
            }
            return Math.max(0, 1 - 2 * outside / Math.pow(2, count));
        }
    }

    /**
     * Judges the rounds of all starts.
     *
     * @param figure a positive number, such as a time
     */
    static <T> BuildVerdict of(List<List<Round<T>>> starts, ToDoubleFunction<T> figure) {
        Interval change = interval(
                starts,
                round -> (logarithm(figure, round.now) + logarithm(figure, round.again)) / 2
                        - logarithm(figure, round.before));
        Interval itself = interval(starts, round -> logarithm(figure, round.now) - logarithm(figure, round.again));
        double noise = Math.max(LEAST_NOISE, Math.max(itself.high, 1 / itself.low) - 1);
        return new BuildVerdict(change, itself, noise, kind(starts.size(), change, noise));
    }

    private static <T> double logarithm(ToDoubleFunction<T> figure, T turn) {
        return Math.log(figure.applyAsDouble(turn));
    }

    private static <T> Interval interval(List<List<Round<T>>> starts, ToDoubleFunction<Round<T>> logarithm) {
        return Interval.ofMedian(starts.stream()
                .mapToDouble(rounds -> SampleStatistics.of(
                                rounds.stream().mapToDouble(logarithm).toArray())
                        .median())
                .toArray());
    }

    private static Kind kind(int starts, Interval change, double noise) {
        if (starts < LEAST_STARTS) {
            return Kind.TOO_FEW_STARTS;
        }
        return change.low > 1 + noise ? Kind.MORE : change.high < 1 / (1 + noise) ? Kind.LESS : Kind.NO_DIFFERENCE;
    }
}
