package io.troupe.demo.evaluate;

import io.troupe.tools.SampleStatistics;
import java.util.List;

/** Whether our measurements confirm a claim. */
enum ClaimVerdict {
    HOLDS("holds"),
    DOES_NOT_HOLD("DOES NOT HOLD"),
    CANNOT_BE_TOLD("cannot be told");

    /**
     * Fewer repetitions allow no statement about their spread. With five repetitions, and for one number of cores, a
     * difference by pure chance is reported in 19 % of cases; with 15 repetitions in 2 to 6 %.
     */
    static final int ENOUGH_REPETITIONS = 5;
    /** With fewer repetitions, the smallest relative difference that counts. */
    static final double PLAIN_DIFFERENCE = 0.1;

    private final String words;

    ClaimVerdict(String words) {
        this.words = words;
    }

    /**
     * Whether ratios exceed a limit: they do if their lower quartile is above it, and do not if their upper quartile is
     * at or below it. With fewer than {@value #ENOUGH_REPETITIONS} values, the quartile must be beyond the limit by
     * {@value #PLAIN_DIFFERENCE} times the limit, unless all values equal the limit.
     */
    static ClaimVerdict above(double[] ratios, double limit) {
        SampleStatistics spread = SampleStatistics.of(ratios);
        double margin = ratios.length < ENOUGH_REPETITIONS ? PLAIN_DIFFERENCE * limit : 0;
        boolean exactly = spread.least() == limit && spread.most() == limit;
        if (!exactly && spread.lowerQuartile() > limit + margin) {
            return HOLDS;
        }
        return exactly || spread.upperQuartile() <= limit - margin ? DOES_NOT_HOLD : CANNOT_BE_TOLD;
    }

    /**
     * Whether the quartiles lie between two bounds. They do not if the lower one is above or the upper one below. With
     * fewer than {@value #ENOUGH_REPETITIONS} values, they must be outside by {@value #PLAIN_DIFFERENCE} of the bound
     * to reject the claim.
     */
    static ClaimVerdict within(double[] values, double from, double to) {
        SampleStatistics spread = SampleStatistics.of(values);
        double margin = values.length < ENOUGH_REPETITIONS ? PLAIN_DIFFERENCE : 0;
        if (spread.lowerQuartile() >= from && spread.upperQuartile() <= to) {
            return HOLDS;
        }
        boolean outside = spread.lowerQuartile() > to * (1 + margin) || spread.upperQuartile() < from * (1 - margin);
        return outside ? DOES_NOT_HOLD : CANNOT_BE_TOLD;
    }

    /**
     * The verdict on values that vary from run to run: it requires at least {@value #ENOUGH_REPETITIONS} repetitions.
     */
    ClaimVerdict ifRepeated(int repetitions) {
        return repetitions < ENOUGH_REPETITIONS ? CANNOT_BE_TOLD : this;
    }

    /** The verdict on a claim measured under several conditions: the common one, if all agree. */
    static ClaimVerdict agreed(List<ClaimVerdict> verdicts) {
        return verdicts.stream().distinct().count() == 1 ? verdicts.getFirst() : CANNOT_BE_TOLD;
    }

    @Override
    public String toString() {
        return words;
    }
}
