package io.troupe.sim;

/**
 * How fast a {@link SimulationRunner} advances simulated time. At any pace, a tick waits for the clients that answer.
 */
public sealed interface Pace {
    /**
     * As fast as the clients answer, but in real time while a free-running client is connected: such a client never
     * answers and could not keep up.
     */
    record OfAnswers() implements Pace {}

    /**
     * A fixed number of simulated seconds per second, if the machine and the clients are fast enough.
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

    /** As fast as possible, without waiting for the clock. */
    record Unlimited() implements Pace {}

    /** Simulated seconds per second; infinite if ticks do not wait for the clock. */
    default double factor(boolean hasFreeRunningClient) {
        return switch (this) {
            case OfAnswers answers -> hasFreeRunningClient ? 1 : Double.POSITIVE_INFINITY;
            case RealTime real -> real.factor();
            case Unlimited unlimited -> Double.POSITIVE_INFINITY;
        };
    }
}
