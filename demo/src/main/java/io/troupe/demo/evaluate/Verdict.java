package io.troupe.demo.evaluate;

import java.util.List;

/** Whether what the paper says is what we find. */
enum Verdict {
    HOLDS("holds"),
    DOES_NOT_HOLD("DOES NOT HOLD"),
    CANNOT_BE_TOLD("cannot be told");

    /**
     * Fewer repetitions say nothing of how far they spread. Where only chance decides which of two takes more, so many
     * say of the one that it does, for one number of cores, in 19 of 100 cases, and 15 repetitions in 2 to 6 of 100.
     */
    static final int ENOUGH_REPETITIONS = 5;
    /** With fewer repetitions a difference must be so large, relatively, to count. */
    static final double PLAIN_DIFFERENCE = 0.1;

    private final String words;

    Verdict(String words) {
        this.words = words;
    }

    /**
     * Whether quotients are above a limit: they are if three quarters of them are, they are not if three quarters are
     * at it or below. Of fewer than {@value #ENOUGH_REPETITIONS} all must be plainly above, or plainly below, or all
     * exactly at the limit.
     */
    static Verdict above(double[] ratios, double limit) {
        Spread spread = Spread.of(ratios);
        double margin = ratios.length < ENOUGH_REPETITIONS ? PLAIN_DIFFERENCE * limit : 0;
        boolean exactly = spread.least() == limit && spread.most() == limit;
        if (!exactly && spread.lowerQuartile() > limit + margin) {
            return HOLDS;
        }
        return exactly || spread.upperQuartile() <= limit - margin ? DOES_NOT_HOLD : CANNOT_BE_TOLD;
    }

    /**
     * Whether the quartiles lie between two bounds: not if the one is above or the other below. Of fewer than
     * {@value #ENOUGH_REPETITIONS} values one must be plainly outside to say no.
     */
    static Verdict within(double[] values, double from, double to) {
        Spread spread = Spread.of(values);
        double margin = values.length < ENOUGH_REPETITIONS ? PLAIN_DIFFERENCE : 0;
        if (spread.lowerQuartile() >= from && spread.upperQuartile() <= to) {
            return HOLDS;
        }
        boolean outside = spread.lowerQuartile() > to * (1 + margin) || spread.upperQuartile() < from * (1 - margin);
        return outside ? DOES_NOT_HOLD : CANNOT_BE_TOLD;
    }

    /** What is found by numbers that are never twice the same: only by {@value #ENOUGH_REPETITIONS} or more. */
    Verdict ifRepeated(int repetitions) {
        return repetitions < ENOUGH_REPETITIONS ? CANNOT_BE_TOLD : this;
    }

    /** Of the same claim under several conditions: what is found under all of them. */
    static Verdict agreed(List<Verdict> verdicts) {
        return verdicts.stream().distinct().count() == 1 ? verdicts.getFirst() : CANNOT_BE_TOLD;
    }

    @Override
    public String toString() {
        return words;
    }
}
