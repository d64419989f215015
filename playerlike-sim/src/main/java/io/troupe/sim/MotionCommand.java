package io.troupe.sim;

import io.troupe.sim.model.DriveSpec.Steering;
import io.troupe.sim.model.Pose;

/** A motion command, in force until the next one. */
sealed interface MotionCommand {
    Velocity STILL = new Velocity(0, 0);

    /**
     * Speed to drive at now, before the world clamps it.
     *
     * @param odometry pose that odometry reports
     */
    Velocity now(Pose odometry, Steering steering);

    /**
     * @param sidewaysMps to the left; ignored unless the drive is omnidirectional
     * @param turnRadps left positive; for a car the angle of the front wheels
     */
    record Velocity(double forwardMps, double sidewaysMps, double turnRadps) implements MotionCommand {
        Velocity(double forwardMps, double turnRadps) {
            this(forwardMps, 0, turnRadps);
        }

        @Override
        public Velocity now(Pose odometry, Steering steering) {
            return this;
        }
    }

    /**
     * Drives at a speed and steers to a heading in the odometry frame. The turn rate is the heading error per second,
     * at most 1 rad/s.
     *
     * <p>Stage ignores this command; the robot is steered as for {@link GoTo}.
     */
    record Heading(double forwardMps, double headingRad) implements MotionCommand {
        @Override
        public Velocity now(Pose odometry, Steering steering) {
            return new Velocity(forwardMps, turn(headingRad, odometry));
        }
    }

    /**
     * Drives to a pose in the odometry frame and stands there.
     *
     * <p>While the goal is more than 2 cm away along x or y, the robot turns towards it, by the heading error per
     * second. It drives only while that error is below 11.25 degrees, by the distance per second, at most 0.4 m/s.
     * Nearer to the goal it turns to the final heading in the same way.
     *
     * <p>An omnidirectional robot drives and turns at the same time: along each of its axes by the distance per second,
     * at most 0.4 m/s, and to the final heading.
     *
     * <p><b>Source.</b> Stage's position control. By a mistake there, its limit of 1 rad/s holds for right turns only;
     * here it holds for both. For an omnidirectional robot it takes the distances along the axes of the odometry frame
     * for those along the robot's axes; here they are converted.
     */
    record GoTo(Pose goal) implements MotionCommand {
        private static final double NEAR_M = 0.02;
        private static final double FASTEST_MPS = 0.4;
        private static final double AHEAD_RAD = StrictMath.PI / 16;

        @Override
        public Velocity now(Pose odometry, Steering steering) {
            double dx = goal.x() - odometry.x();
            double dy = goal.y() - odometry.y();
            if (steering instanceof Steering.Omnidirectional) {
                double cos = StrictMath.cos(odometry.headingRad());
                double sin = StrictMath.sin(odometry.headingRad());
                return new Velocity(
                        Math.clamp(cos * dx + sin * dy, -FASTEST_MPS, FASTEST_MPS),
                        Math.clamp(cos * dy - sin * dx, -FASTEST_MPS, FASTEST_MPS),
                        turn(goal.headingRad(), odometry));
            }
            if (Math.abs(dx) <= NEAR_M && Math.abs(dy) <= NEAR_M) {
                return new Velocity(0, turn(goal.headingRad(), odometry));
            }
            double towardsRad = StrictMath.atan2(dy, dx);
            boolean ahead = Math.abs(error(towardsRad, odometry)) < AHEAD_RAD;
            double forwardMps = ahead ? Math.min(StrictMath.hypot(dx, dy), FASTEST_MPS) : 0;
            return new Velocity(forwardMps, turn(towardsRad, odometry));
        }
    }

    private static double turn(double towardsRad, Pose odometry) {
        return Math.clamp(error(towardsRad, odometry), -1.0, 1.0);
    }

    private static double error(double towardsRad, Pose odometry) {
        return StrictMath.IEEEremainder(towardsRad - odometry.headingRad(), 2 * StrictMath.PI);
    }
}
