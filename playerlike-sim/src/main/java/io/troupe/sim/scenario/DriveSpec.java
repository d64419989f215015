package io.troupe.sim.scenario;

/**
 * How a robot starts, what limits it and how it knows where it is.
 *
 * @param startForwardMps the speed it has before anybody commands it ({@code velocity})
 * @param startTurnRadps the turn rate, left positive
 * @param velocityBounds no command exceeds them; {@link Bounds#NONE} in the classic dialect
 * @param accelerationBounds told to clients; like Stage, the simulator reaches a commanded speed at once
 * @param localization what odometry reports
 */
public record DriveSpec(
        double startForwardMps,
        double startTurnRadps,
        Bounds velocityBounds,
        Bounds accelerationBounds,
        Localization localization) {
    /** At rest, unlimited, with true odometry. */
    public static final DriveSpec STANDARD = new DriveSpec(0, 0, Bounds.NONE, Bounds.NONE, new Localization.Gps());

    public DriveSpec withLocalization(Localization other) {
        return new DriveSpec(startForwardMps, startTurnRadps, velocityBounds, accelerationBounds, other);
    }

    /**
     * The least and the greatest of a motion.
     *
     * <p><b>Units and shapes.</b> m/s and rad/s of velocities, m/s² and rad/s² of accelerations; infinite where there
     * is no limit.
     */
    public record Bounds(double leastForward, double mostForward, double leastTurn, double mostTurn) {
        public static final Bounds NONE = new Bounds(
                Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY);
    }

    /** Where odometry gets its pose from. */
    public sealed interface Localization {
        /** It is told the true pose. */
        record Gps() implements Localization {}

        /**
         * It adds up what the wheels do. Each run draws one error for each axis, evenly from plus or minus half of
         * these, and is off by that share of every motion.
         *
         * @param forward share of a motion along the robot's x axis
         * @param sideways share of a motion along its y axis
         * @param turn share of a turn
         */
        record DeadReckoning(double forward, double sideways, double turn) implements Localization {}
    }
}
