package io.troupe.sim;

import io.troupe.sim.scenario.Pose;

/** What a robot has been told to do with its wheels, until it is told something else. */
sealed interface Drive {
    Velocity STILL = new Velocity(0, 0);

    /** How fast to drive now, given where odometry says that the robot is; the world clamps it. */
    Velocity now(Pose odometry);

    /** @param turnRadps left positive */
    record Velocity(double forwardMps, double turnRadps) implements Drive {
        @Override
        public Velocity now(Pose odometry) {
            return this;
        }
    }

    /**
     * At a speed, steering to a heading in the odometry frame: it turns at the heading's error per second, at most 1
     * rad/s.
     *
     * <p>Stage does nothing about this command; the way to steer is that of {@link GoTo}.
     */
    record Heading(double forwardMps, double headingRad) implements Drive {
        @Override
        public Velocity now(Pose odometry) {
            return new Velocity(forwardMps, turn(headingRad, odometry));
        }
    }

    /**
     * To a pose in the odometry frame, and then standing there.
     *
     * <p>Farther than 2 cm away along x or y it turns towards the goal, at the heading's error per second, and drives
     * only while that error is below 11.25 degrees, at the distance per second, at most 0.4 m/s. Nearer, it turns to
     * the final heading in the same way.
     *
     * <p><b>Source.</b> Stage's position control; its limit of 1 rad/s holds to the right only, by a slip, here on both
     * sides.
     */
    record GoTo(Pose goal) implements Drive {
        private static final double NEAR_M = 0.02;
        private static final double FASTEST_MPS = 0.4;
        private static final double AHEAD_RAD = StrictMath.PI / 16;

        @Override
        public Velocity now(Pose odometry) {
            double dx = goal.x() - odometry.x();
            double dy = goal.y() - odometry.y();
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
