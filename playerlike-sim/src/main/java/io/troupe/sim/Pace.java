package io.troupe.sim;

/**
 * How fast a {@link SimulationRunner} lets simulated time pass. Whatever the pace, a tick waits for the clients that
 * answer.
 */
public sealed interface Pace {
    /** As fast as the clients answer; in real time while there is one that never answers, who would else be overrun. */
    record OfAnswers() implements Pace {}

    /**
     * So many simulated seconds in a second, if the machine and the clients are fast enough.
     *
     * @param factor above 0; 1 is real time
     */
    record RealTime(double factor) implements Pace {
        public RealTime {
            if (!(factor > 0 && factor < Double.POSITIVE_INFINITY)) {
                throw new IllegalArgumentException("pace is " + factor + " times real time, expected more than 0");
            }
        }
    }

    /** As fast as possible. */
    record Unlimited() implements Pace {}

    /** Simulated seconds in a second; infinite if nobody shall wait for the time. */
    default double factor(boolean somebodyNeverAnswers) {
        return switch (this) {
            case OfAnswers answers -> somebodyNeverAnswers ? 1 : Double.POSITIVE_INFINITY;
            case RealTime real -> real.factor();
            case Unlimited unlimited -> Double.POSITIVE_INFINITY;
        };
    }
}
