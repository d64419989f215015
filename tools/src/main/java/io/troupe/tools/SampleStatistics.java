package io.troupe.tools;

import java.util.Arrays;
import java.util.Collection;
import java.util.Locale;
import java.util.function.DoubleFunction;

/**
 * Median, quartiles and extremes of repeated measurements.
 *
 * <p><b>Units and shapes.</b> The values keep their unit. Quantiles are interpolated linearly between neighbouring
 * sorted values.
 */
public record SampleStatistics(
        double median, double lowerQuartile, double upperQuartile, double least, double most, int count) {
    /**
     * Computes the statistics of the values.
     *
     * @throws IllegalArgumentException if there are none, or one is not finite
     */
    public static SampleStatistics of(double... values) {
        if (values.length == 0) {
            throw new IllegalArgumentException("0 values, expected at least one");
        }
        double[] sorted = values.clone();
        Arrays.sort(sorted);
        for (double value : sorted) {
            if (!Double.isFinite(value)) {
                throw new IllegalArgumentException("a value is " + value + ", expected a finite number");
            }
        }
        return new SampleStatistics(
                quantile(sorted, 0.5),
                quantile(sorted, 0.25),
                quantile(sorted, 0.75),
                sorted[0],
                sorted[sorted.length - 1],
                sorted.length);
    }

    /**
     * Computes the statistics of the values.
     *
     * @throws IllegalArgumentException if there are none, or one is not finite
     */
    public static SampleStatistics of(Collection<Double> values) {
        return of(values.stream().mapToDouble(Double::doubleValue).toArray());
    }

    /**
     * The value below which the given share of the values lies.
     *
     * @param sorted in ascending order, at least one
     */
    public static double quantile(double[] sorted, double share) {
        double at = share * (sorted.length - 1);
        int below = (int) Math.floor(at);
        int above = Math.min(below + 1, sorted.length - 1);
        return sorted[below] + (at - below) * (sorted[above] - sorted[below]);
    }

    /** Half the distance between the quartiles. */
    public double halfWidth() {
        return (upperQuartile - lowerQuartile) / 2;
    }

    /** The median, followed by the quartiles in brackets if they differ from it in the printed digits. */
    public String text(int decimals) {
        String format = "%." + decimals + "f";
        String middle = String.format(Locale.ROOT, format, median);
        String lower = String.format(Locale.ROOT, format, lowerQuartile);
        String upper = String.format(Locale.ROOT, format, upperQuartile);
        return lower.equals(upper) ? middle : middle + " (" + lower + ".." + upper + ")";
    }

    /** The median, followed by the quartiles in brackets. */
    public String text(DoubleFunction<String> number) {
        return number.apply(median) + " (" + number.apply(lowerQuartile) + ".." + number.apply(upperQuartile) + ")";
    }
}
