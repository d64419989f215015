package io.troupe.sim;

import io.troupe.sim.device.Ranger;
import io.troupe.sim.scenario.OdometryError;
import io.troupe.sim.scenario.RobotSpec;
import java.util.List;
import java.util.stream.IntStream;

/**
 * Random errors of a robot's devices. Each device has a separate random stream, seeded with the names of robot and
 * device.
 */
final class Noise {
    private Noise() {}

    /** Odometry error of this run, uniform within plus or minus half of the specified proportions. */
    static OdometryError ofOdometry(RobotSpec robot, long seed) {
        OdometryError most = robot.odometryError();
        if (most.equals(OdometryError.NONE)) {
            return most;
        }
        for (double proportion : new double[] {most.x(), most.y(), most.heading()}) {
            if (!(proportion >= 0 && proportion < 2)) {
                throw new IllegalArgumentException(
                        "odometry error is " + most + ", expected proportions from 0 to less than 2");
            }
        }
        var random = new RandomStream(seed, robot.name(), "odometry");
        return new OdometryError(
                random.nextWithin(most.x() / 2),
                random.nextWithin(most.y() / 2),
                random.nextWithin(most.heading() / 2));
    }

    static List<Ranger> rangers(RobotSpec robot, long seed) {
        return IntStream.range(0, robot.rangers().size())
                .mapToObj(i -> new Ranger(
                        robot.rangers().get(i), new RandomStream(seed, robot.name(), "ranger" + i)::nextWithin))
                .toList();
    }
}
