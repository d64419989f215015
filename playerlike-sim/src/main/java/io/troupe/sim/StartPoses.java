package io.troupe.sim;

import io.troupe.sim.device.Clearance;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;

/** Where the robots begin: the poses of the world file, moved a little by the seed. */
final class StartPoses {
    private static final int TRIES = 100;

    private StartPoses() {}

    static List<Pose> draw(WorldSpec spec, WorldSettings settings) {
        var starts = new ArrayList<Pose>();
        for (int robot = 0; robot < spec.robots().size(); robot++) {
            starts.add(draw(spec, settings, robot, starts));
        }
        return starts;
    }

    private static Pose draw(WorldSpec spec, WorldSettings settings, int robot, List<Pose> before) {
        RobotSpec robotSpec = spec.robots().get(robot);
        if (settings.jitterM() == 0 && settings.jitterRad() == 0) {
            return robotSpec.pose();
        }
        var others = new Clearance();
        spec.obstacles().stream()
                .filter(ObstacleSpec::blocksBodies)
                .forEach(each -> others.add(each.shape(), each.pose()));
        for (int other = 0; other < before.size(); other++) {
            others.add(spec.robots().get(other).shape(), before.get(other));
        }
        Random random = stream(settings.seed(), robot);
        for (int attempt = 0; attempt < TRIES; attempt++) {
            Pose pose = jitter(robotSpec.pose(), settings, random);
            if (others.of(robotSpec.shape(), pose) > 0) {
                return pose;
            }
        }
        throw new IllegalArgumentException(robotSpec.where() + ": " + robotSpec.name() + " finds no free place within "
                + settings.jitterM() + " m of its start pose in " + TRIES + " tries");
    }

    private static Pose jitter(Pose pose, WorldSettings settings, Random random) {
        return new Pose(
                pose.x() + symmetric(random, settings.jitterM()),
                pose.y() + symmetric(random, settings.jitterM()),
                pose.headingRad() + symmetric(random, settings.jitterRad()));
    }

    private static double symmetric(Random random, double bound) {
        return (2 * random.nextDouble() - 1) * bound;
    }

    /** A stream of its own for each robot, so that adding one moves no other; {@link Random} because its numbers are specified. */
    private static Random stream(long seed, int robot) {
        long mixed = seed * 0x9E3779B97F4A7C15L + (robot + 1) * 0xBF58476D1CE4E5B9L;
        mixed ^= mixed >>> 31;
        return new Random(mixed * 0x94D049BB133111EBL);
    }
}
