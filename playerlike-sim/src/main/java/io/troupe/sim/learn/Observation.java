package io.troupe.sim.learn;

import io.troupe.sim.WorldView;
import java.util.Arrays;

/**
 * What all robots sense and where they are after a step; immutable.
 *
 * <p><b>Units and shapes.</b> SI; robots and sonars count from 0. Poses are true ones, in the world's frame, not those
 * of odometry.
 */
public final class Observation {
    private static final int POSE = 3;

    private final double timeS;
    private final double[] poses;
    private final double[][] rangesM;
    private final boolean[] stalled;
    private final boolean[] collided;

    Observation(WorldView view) {
        int robots = view.robotCount();
        timeS = view.timeMicros() / 1e6;
        poses = new double[POSE * robots];
        rangesM = new double[robots][];
        stalled = new boolean[robots];
        collided = new boolean[robots];
        for (int robot = 0; robot < robots; robot++) {
            poses[POSE * robot] = view.x(robot);
            poses[POSE * robot + 1] = view.y(robot);
            poses[POSE * robot + 2] = view.headingRad(robot);
            rangesM[robot] = new double[view.sonarCount(robot)];
            for (int sonar = 0; sonar < rangesM[robot].length; sonar++) {
                rangesM[robot][sonar] = view.rangeM(robot, sonar);
            }
            stalled[robot] = view.stalled(robot);
        }
        for (int contact = 0; contact < view.contactCount(); contact++) {
            collided[view.contactRobot(contact)] = true;
            if (view.contactOtherRobot(contact) >= 0) {
                collided[view.contactOtherRobot(contact)] = true;
            }
        }
    }

    /** Simulated time since the reset. */
    public double timeS() {
        return timeS;
    }

    public double x(int robot) {
        return poses[POSE * robot];
    }

    public double y(int robot) {
        return poses[POSE * robot + 1];
    }

    /** From -pi to pi. */
    public double headingRad(int robot) {
        return poses[POSE * robot + 2];
    }

    /** Number of a robot's sonars. */
    public int sonarCount(int robot) {
        return rangesM[robot].length;
    }

    /** Range of one sonar. */
    public double rangeM(int robot, int sonar) {
        return rangesM[robot][sonar];
    }

    /** A copy of all ranges of a robot. */
    public double[] rangesM(int robot) {
        return rangesM[robot].clone();
    }

    /** The shortest range of a robot; infinite if it has no sonars. */
    public double leastRangeM(int robot) {
        return Arrays.stream(rangesM[robot]).min().orElse(Double.POSITIVE_INFINITY);
    }

    /** True if something holds the robot back. */
    public boolean stalled(int robot) {
        return stalled[robot];
    }

    /** True if the robot began to touch something in this step. */
    public boolean collided(int robot) {
        return collided[robot];
    }
}
