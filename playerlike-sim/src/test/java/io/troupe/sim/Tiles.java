package io.troupe.sim;

import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;

/**
 * Crowds of robots: a square of tiles of 16 m by 16 m inside walls. Each tile has six black boxes, three coloured
 * columns and up to 64 robots with 16 sonars of 5 m and a camera of 80 columns over 60 degrees and 8 m.
 */
final class Tiles {
    private static final double TILE_M = 16;
    private static final int ROBOTS_ON_A_TILE = 64;
    private static final double DEGREE = StrictMath.PI / 180;
    private static final int[] COLOURS = {Specs.RED, Specs.GREEN, Specs.BLUE};

    private Tiles() {}

    /** A crowd whose cameras report these colours; none given = all. */
    static WorldSpec world(int robotCount, long seed, Integer... reported) {
        int side = (int) Math.ceil(Math.sqrt(Math.ceil((double) robotCount / ROBOTS_ON_A_TILE)));
        var random = new Random(seed);
        List<ObstacleSpec> obstacles = new ArrayList<>(Specs.arena(side * TILE_M));
        for (int tile = 0; tile < side * side; tile++) {
            addObstacles(obstacles, tile, cornerM(tile % side, side), cornerM(tile / side, side), random);
        }
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < robotCount; i++) {
            int tile = (int) ((long) i * side * side / robotCount);
            int slot = i - (int) Math.ceilDiv((long) tile * robotCount, side * side);
            double x = cornerM(tile % side, side) + 1 + 2 * (slot % 8);
            double y = cornerM(tile / side, side) + 1 + 2 * (slot / 8);
            robots.add(Specs.robot(
                    "r" + i, new Pose(x, y, 6 * random.nextDouble()), Specs.ORANGE, ring(), camera(reported)));
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
            obstacles.add(new ObstacleSpec(
                    "column" + tile + "-" + i, pose, octagon(0.3), COLOURS[i], true, true, true, Specs.at(1)));
        }
    }

    private static Shape octagon(double radiusM) {
        return new Shape(List.of(IntStream.range(0, 8)
                .mapToObj(i ->
                        new Point(radiusM * StrictMath.cos(45 * DEGREE * i), radiusM * StrictMath.sin(45 * DEGREE * i)))
                .toList()));
    }

    private static SonarSpec ring() {
        return new SonarSpec(
                IntStream.range(0, 16)
                        .mapToObj(i -> new Pose(0, 0, 22.5 * DEGREE * i).compose(new Pose(0.15, 0, 0)))
                        .toList(),
                0,
                5,
                15 * DEGREE);
    }

    private static BlobfinderSpec camera(Integer... reported) {
        return new BlobfinderSpec(new Pose(0.1, 0, 0), 80, 60, 8, 60 * DEGREE, List.of(reported));
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
