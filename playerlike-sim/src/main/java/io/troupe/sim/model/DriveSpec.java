package io.troupe.sim.model;

/**
 * Start speed, limits and odometry of a robot.
 *
 * @param startForwardMps speed before the first command ({@code velocity})
 * @param startTurnRadps turn rate before the first command, left positive
 * @param velocityBounds commands are clamped to them; {@link Bounds#NONE} in the classic dialect
 * @param accelerationBounds reported to clients; like Stage, the simulator reaches a commanded speed at once
 * @param localization the kind of odometry
 */
public record DriveSpec(
        double startForwardMps,
        double startTurnRadps,
        Bounds velocityBounds,
        Bounds accelerationBounds,
        Localization localization) {
    /** At rest, unlimited, with exact odometry. */
    public static final DriveSpec STANDARD = new DriveSpec(0, 0, Bounds.NONE, Bounds.NONE, new Localization.Gps());

    public DriveSpec withLocalization(Localization other) {
        return new DriveSpec(startForwardMps, startTurnRadps, velocityBounds, accelerationBounds, other);
    }

    /**
     * Least and greatest values of a motion.
     *
     * <p><b>Units and shapes.</b> m/s and rad/s of velocities, m/s² and rad/s² of accelerations; infinite where there
     * is no limit.
     */
    public record Bounds(double leastForward, double mostForward, double leastTurn, double mostTurn) {
        public static final Bounds NONE = new Bounds(
                Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY);
    }

    /** The source of the odometry pose. */
    public sealed interface Localization {
        /** Odometry follows the true pose. */
        record Gps() implements Localization {}

        /**
         * Odometry sums up the motion of the wheels. Each run draws one error for each axis, uniform within plus or
         * minus half of these shares, and adds that share to every motion.
         *
         * @param forward share of a motion along the robot's x axis
         * @param sideways share of a motion along its y axis
         * @param turn share of a turn
         */
        record DeadReckoning(double forward, double sideways, double turn) implements Localization {}
    }
}
