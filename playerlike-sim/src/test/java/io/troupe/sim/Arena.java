package io.troupe.sim;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.OdometryError;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;

/** Six robots with every kind of device, all noise on, in a room with coloured boxes, and random commands for them. */
public final class Arena {
    private static final double DEGREE = StrictMath.PI / 180;
    private static final RangeNoise NOISE = new RangeNoise(0.02, 0.01, 0.01);

    private Arena() {}

    static RangerSpec laser(RangeNoise noise) {
        return new RangerSpec(
                RangerSpec.Kind.LASER,
                new Pose(0.1, 0, 0),
                0.15,
                0.15,
                List.of(new RangeSensorSpec(new Pose(0.1, 0, 0), 0, 8, 180 * DEGREE, 37, 0.15, 0.15, noise)));
    }

    static RangerSpec ring(RangeNoise noise) {
        var sensors = new ArrayList<RangeSensorSpec>();
        for (Pose mount : Specs.pioneerFront().mounts()) {
            sensors.add(new RangeSensorSpec(mount, 0.1, 5, 15 * DEGREE, 1, 0.01, 0.05, noise));
        }
        return new RangerSpec(RangerSpec.Kind.RANGER, new Pose(-0.04, 0, 90 * DEGREE), 0.4, 0.3, sensors);
    }

    public static WorldSpec spec(int robotCount) {
        List<ObstacleSpec> obstacles = new ArrayList<>(Specs.arena(8));
        obstacles.add(Specs.box("red", new Pose(2, 2, 0.3), 0.6, 0.6, Specs.RED));
        obstacles.add(Specs.box("green", new Pose(-2, 1, 1), 0.5, 0.8, Specs.GREEN));
        obstacles.add(Specs.box("blue", new Pose(0, -2, 2), 0.7, 0.4, Specs.BLUE));
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < robotCount; i++) {
            var start = new Pose(-2.5 + i, i % 2 == 0 ? 0 : 3, i);
            robots.add(Specs.robot("r" + i, start, Specs.ORANGE, Specs.pioneerFront(), Specs.camera(8))
                    .withRangers(List.of(laser(NOISE), ring(NOISE)))
                    .withOdometryError(OdometryError.STAGE));
        }
        return Specs.world(robots, obstacles);
    }

    static WorldSettings seed(long seed) {
        return WorldSettings.DEFAULT.withSeed(seed).withJitter(0.02, 0.035);
    }

    /** Gives every robot a random command for this tick; the robots collide. */
    static void drive(World world, SplittableRandom random) {
        for (int robot = 0; robot < world.spec().robots().size(); robot++) {
            switch (random.nextInt(40)) {
                case 0 -> world.goTo(robot, new Pose(random.nextDouble(-3, 3), random.nextDouble(-3, 3), 1));
                case 1 -> world.steer(robot, 0.3, random.nextDouble(-3, 3));
                case 2 -> world.setOdometry(robot, new Pose(random.nextDouble(), 2, 3));
                case 3 -> world.motorPower(robot, random.nextBoolean());
                case 4, 5, 6, 7, 8 -> world.command(robot, random.nextDouble(0, 0.8), random.nextDouble(-1, 1));
                default -> {}
            }
        }
    }

    /** For a separate JVM: prints the checksum of a run of one minute. */
    public static void main(String[] args) {
        System.out.println(minute(Long.parseLong(args[0])));
    }

    static SnapshotHash minute(long seed) {
        World world = World.create(spec(6), seed(seed));
        var random = new SplittableRandom(seed);
        var hash = new SnapshotHash();
        hash.update(world.latest());
        for (int tick = 0; tick < 600; tick++) {
            drive(world, random);
            if (tick == 400) {
                world.reset();
            }
            hash.update(world.advance());
        }
        return hash;
    }
}
