package io.troupe.sim;

import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.OdometryError;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.SplittableRandom;
import java.util.function.UnaryOperator;
import java.util.stream.IntStream;

/** Robots with every kind of device, all noise on, in a room with coloured boxes, random commands, and crowds. */
public final class Arena {
    private static final double DEGREE = StrictMath.PI / 180;
    private static final RangeNoise NOISE = new RangeNoise(0.02, 0.01, 0.01);

    private Arena() {}

    static RangerSpec laser(RangeNoise noise) {
        var ahead = new Pose(0.1, 0, 0);
        var sensor = new RangeSensorSpec(ahead, 0, 8, 180 * DEGREE, 37, 0.15, 0.15, noise);
        return new RangerSpec(RangerSpec.Kind.LASER, ahead, 0.15, 0.15, List.of(sensor));
    }

    static RangerSpec ring(RangeNoise noise) {
        List<RangeSensorSpec> sensors = Specs.pioneerFront().mounts().stream()
                .map(mount -> new RangeSensorSpec(mount, 0.1, 5, 15 * DEGREE, 1, 0.01, 0.05, noise))
                .toList();
        return new RangerSpec(RangerSpec.Kind.RANGER, new Pose(-0.04, 0, 90 * DEGREE), 0.4, 0.3, sensors);
    }

    public static WorldSpec spec(int robotCount) {
        return spec(
                robotCount,
                robot -> robot.withRangers(List.of(laser(NOISE), ring(NOISE))).withOdometryError(OdometryError.STAGE));
    }

    /** Robots with sonars and cameras only, changed by the operator. */
    static WorldSpec spec(int robotCount, UnaryOperator<RobotSpec> change) {
        List<ObstacleSpec> obstacles = new ArrayList<>(Specs.arena(8));
        obstacles.add(Specs.box("red", new Pose(2, 2, 0.3), 0.6, 0.6, Specs.RED));
        obstacles.add(Specs.box("green", new Pose(-2, 1, 1), 0.5, 0.8, Specs.GREEN));
        obstacles.add(Specs.box("blue", new Pose(0, -2, 2), 0.7, 0.4, Specs.BLUE));
        List<RobotSpec> robots = IntStream.range(0, robotCount)
                .mapToObj(i -> Specs.robot(
                        "r" + i,
                        new Pose(-2.5 + i, i % 2 == 0 ? 0 : 3, i),
                        Specs.ORANGE,
                        Specs.pioneerFront(),
                        Specs.camera(8)))
                .map(change)
                .toList();
        return Specs.world(robots, obstacles);
    }

    static WorldSettings seed(long seed) {
        return WorldSettings.defaults().withSeed(seed).withJitter(0.02, 0.035);
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

    // ---- crowds: square tiles of 16 m inside walls, each with six black boxes, three coloured columns and up to 64
    // robots, which have 16 sonars of 5 m and a camera of 80 columns over 60 degrees and 8 m

    private static final double TILE_M = 16;
    private static final int ROBOTS_ON_A_TILE = 64;
    private static final int[] COLOURS = {Specs.RED, Specs.GREEN, Specs.BLUE};

    /** A crowd whose cameras report these colours; none given = all. */
    static WorldSpec crowd(int robotCount, long seed, Integer... reported) {
        int side = (int) Math.ceil(Math.sqrt(Math.ceil((double) robotCount / ROBOTS_ON_A_TILE)));
        var random = new Random(seed);
        List<ObstacleSpec> obstacles = new ArrayList<>(Specs.arena(side * TILE_M));
        for (int tile = 0; tile < side * side; tile++) {
            addObstacles(obstacles, tile, cornerM(tile % side, side), cornerM(tile / side, side), random);
        }
        var camera = new BlobfinderSpec(new Pose(0.1, 0, 0), 80, 60, 8, 60 * DEGREE, List.of(reported));
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < robotCount; i++) {
            int tile = (int) ((long) i * side * side / robotCount);
            int slot = i - (int) Math.ceilDiv((long) tile * robotCount, side * side);
            double x = cornerM(tile % side, side) + 1 + 2 * (slot % 8);
            double y = cornerM(tile / side, side) + 1 + 2 * (slot / 8);
            var pose = new Pose(x, y, 6 * random.nextDouble());
            robots.add(Specs.robot("r" + i, pose, Specs.ORANGE, ring(), camera));
        }
        return Specs.world(robots, obstacles);
    }

    private static double cornerM(int index, int side) {
        return (index - side / 2.0) * TILE_M;
    }

    /** Places obstacles where the robots' places on the tile leave room. */
    private static void addObstacles(List<ObstacleSpec> obstacles, int tile, double x, double y, Random random) {
        for (int i = 0; i < 6; i++) {
            var pose = new Pose(x + 2 + 2 * random.nextInt(7), y + 2 + 4 * (i % 4), 3 * random.nextDouble());
            obstacles.add(Specs.box("box" + tile + "-" + i, pose, 0.6 + random.nextDouble(), 0.4, Specs.BLACK));
        }
        for (int i = 0; i < COLOURS.length; i++) {
            var pose = new Pose(x + 2 + 2 * random.nextInt(7), y + 4 + 4 * i, 0);
            obstacles.add(Specs.obstacle("column" + tile + "-" + i, pose, octagon(0.3), COLOURS[i]));
        }
    }

    private static Shape octagon(double radiusM) {
        return new Shape(List.of(IntStream.range(0, 8)
                .mapToDouble(i -> 45 * DEGREE * i)
                .mapToObj(angle -> new Point(radiusM * StrictMath.cos(angle), radiusM * StrictMath.sin(angle)))
                .toList()));
    }

    private static SonarSpec ring() {
        var mounts =
                IntStream.range(0, 16).mapToObj(i -> new Pose(0, 0, 22.5 * DEGREE * i).compose(new Pose(0.15, 0, 0)));
        return new SonarSpec(mounts.toList(), 0, 5, 15 * DEGREE);
    }

    /**
     * Drives all robots by sonar; each eighth robot ignores its sonars and drives straight on, so that there are
     * contacts.
     */
    static void wander(WorldView view) {
        for (int i = 0; i < view.robotCount(); i++) {
            double left = least(view, i, 1, 2, 3);
            double right = least(view, i, 15, 14, 13);
            if (i % 8 == 0) {
                view.command(i, 0.4, 0.05);
            } else if (Math.min(Math.min(left, right), view.rangeM(i, 0)) > 0.5) {
                view.command(i, Math.min(0.5, (left + right) / 4), (left - right) / 5);
            } else {
                view.command(i, 0, left < right ? -0.5 : 0.5);
            }
        }
    }

    private static double least(WorldView view, int robot, int a, int b, int c) {
        return Math.min(view.rangeM(robot, a), Math.min(view.rangeM(robot, b), view.rangeM(robot, c)));
    }
}
