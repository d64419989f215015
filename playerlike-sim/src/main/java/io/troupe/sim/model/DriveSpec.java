package io.troupe.sim.model;

/**
 * Start speed, limits and odometry of a robot.
 *
 * @param startForwardMps speed before the first command ({@code velocity})
 * @param startTurnRadps turn rate before the first command, left positive
 * @param velocityBounds commands are clamped to them; {@link Bounds#NONE} in the classic dialect
 * @param accelerationBounds obeyed if the settings of the world demand it; otherwise, as in Stage, a commanded speed is
 *     reached at once
 * @param localization the kind of odometry
 * @param steering how it moves ({@code drive})
 * @param startSidewaysMps speed to the left before the first command; 0 unless it is omnidirectional
 */
public record DriveSpec(
        double startForwardMps,
        double startTurnRadps,
        Bounds velocityBounds,
        Bounds accelerationBounds,
        Localization localization,
        Steering steering,
        double startSidewaysMps) {
    /** At rest, unlimited, with exact odometry. */
    public static final DriveSpec STANDARD = new DriveSpec(0, 0, Bounds.NONE, Bounds.NONE, new Localization.Gps());

    /** Creates a differential drive. */
    public DriveSpec(
            double startForwardMps,
            double startTurnRadps,
            Bounds velocityBounds,
            Bounds accelerationBounds,
            Localization localization) {
        this(
                startForwardMps,
                startTurnRadps,
                velocityBounds,
                accelerationBounds,
                localization,
                new Steering.Differential(),
                0);
    }

    public DriveSpec withLocalization(Localization other) {
        return new DriveSpec(
                startForwardMps, startTurnRadps, velocityBounds, accelerationBounds, other, steering, startSidewaysMps);
    }

    /** How a robot moves. */
    public sealed interface Steering {
        /** Two driven wheels: it moves ahead and turns. */
        record Differential() implements Steering {}

        /** It moves in every direction and turns, independently. */
        record Omnidirectional() implements Steering {}

        /**
         * It steers like a car. The turn rate of a command is the angle of the front wheels, left positive: at speed v
         * and angle a it moves ahead at v cos a and turns at v sin a / wheelbase, as in Stage.
         */
        record Car(double wheelbaseM) implements Steering {}
    }

    /**
     * Least and greatest values of a motion.
     *
     * <p><b>Units and shapes.</b> m/s and rad/s of velocities, m/s² and rad/s² of accelerations; infinite where there
     * is no limit.
     */
    public record Bounds(
            double leastForward,
            double mostForward,
            double leastSideways,
            double mostSideways,
            double leastTurn,
            double mostTurn) {
        public static final Bounds NONE = new Bounds(
                Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY);

        /** Creates bounds without a limit to motion sideways. */
        public Bounds(double leastForward, double mostForward, double leastTurn, double mostTurn) {
            this(leastForward, mostForward, Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY, leastTurn, mostTurn);
        }
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
