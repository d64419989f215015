package io.troupe.bench.worlds;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The scene that all contenders simulate: tiles of 16 m by 16 m, each with six wall boxes, three coloured objects and
 * at most 64 robots, and four walls around all of them. The middle is the origin.
 */
final class TiledScene {
    static final int SONARS = 16;
    static final int COLUMNS = 80;
    static final double SONAR_RANGE_M = 5;
    static final double CAMERA_RANGE_M = 8;
    static final double COLOURED_RADIUS_M = 0.25;
    static final int INTERVAL_MILLIS = 100;
    static final int STEPS_PER_INTERVAL = 10;
    static final double STEP_S = 0.01;

    private static final int WALL = 0x000000;
    private static final int ROBOT = 0xFFA500;
    private static final double TILE_M = 16;
    private static final int SLOTS_PER_SIDE = 8;
    private static final int SLOTS = SLOTS_PER_SIDE * SLOTS_PER_SIDE;
    private static final double SLOT_M = TILE_M / SLOTS_PER_SIDE;
    private static final double WALL_M = 0.2;
    private static final double GOLDEN_ANGLE_RAD = 2.399963229728653;
    private static final SourcePosition NOWHERE = new SourcePosition(Path.of("tiles.world"), 1, 1);

    private static final SonarSpec SONAR = new SonarSpec(
            IntStream.range(0, SONARS)
                    .mapToObj(i -> 2 * StrictMath.PI * i / SONARS)
                    .map(rad -> new Pose(0.15 * StrictMath.cos(rad), 0.15 * StrictMath.sin(rad), rad))
                    .toList(),
            0,
            SONAR_RANGE_M,
            StrictMath.toRadians(15));
    private static final BlobfinderSpec CAMERA = new BlobfinderSpec(
            Pose.ORIGIN, COLUMNS, 60, CAMERA_RANGE_M, StrictMath.toRadians(60), List.of(0xFF0000, 0x00FF00, 0x0000FF));

    private final int robotCount;
    private final int columns;
    private final int rows;

    private TiledScene(int robotCount) {
        this.robotCount = robotCount;
        int tiles = Math.ceilDiv(robotCount, SLOTS);
        columns = (int) Math.ceil(Math.sqrt(tiles));
        rows = Math.ceilDiv(tiles, columns);
    }

    static WorldSpec of(int robotCount) {
        var scene = new TiledScene(robotCount);
        return new WorldSpec("tiles", Path.of("tiles.world"), INTERVAL_MILLIS, scene.robots(), scene.obstacles());
    }

    /** The scene without cameras. */
    static WorldSpec withSonarsOnly(int robotCount) {
        WorldSpec full = of(robotCount);
        List<RobotSpec> robots = new ArrayList<>();
        for (RobotSpec robot : full.robots()) {
            robots.add(robot(robot.name(), robot.pose(), null));
        }
        return new WorldSpec(full.name(), full.file(), INTERVAL_MILLIS, robots, full.obstacles());
    }

    /** Whether this is the colour of a coloured object, not of a wall or a robot. */
    static boolean isColoured(int colour) {
        return colour != WALL && colour != ROBOT;
    }

    /** Distributes the robots over the tiles in turn; within a tile, steps of 27, which is odd, reach all 64 slots. */
    private List<RobotSpec> robots() {
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < robotCount; i++) {
            int tile = i % (columns * rows);
            int slot = (i / (columns * rows) * 27 + 13) % SLOTS;
            double x = left(tile) + (slot % SLOTS_PER_SIDE + 0.5) * SLOT_M;
            double y = bottom(tile) + (slot / SLOTS_PER_SIDE + 0.5) * SLOT_M;
            robots.add(robot("r" + i, new Pose(x, y, i * GOLDEN_ANGLE_RAD % (2 * StrictMath.PI)), CAMERA));
        }
        return robots;
    }

    private static RobotSpec robot(String name, Pose pose, @Nullable BlobfinderSpec camera) {
        return new RobotSpec(
                name,
                pose,
                box(0.44, 0.33),
                ROBOT,
                0.44,
                0.33,
                23,
                Pose.ORIGIN,
                Pose.ORIGIN,
                SONAR,
                camera,
                List.of(),
                true,
                true,
                NOWHERE);
    }

    private List<ObstacleSpec> obstacles() {
        List<ObstacleSpec> obstacles = new ArrayList<>();
        double halfX = columns * TILE_M / 2;
        double halfY = rows * TILE_M / 2;
        double outX = halfX + WALL_M / 2;
        double outY = halfY + WALL_M / 2;
        obstacles.add(obstacle(outX, 0, box(WALL_M, 2 * (halfY + WALL_M)), WALL));
        obstacles.add(obstacle(-outX, 0, box(WALL_M, 2 * (halfY + WALL_M)), WALL));
        obstacles.add(obstacle(0, outY, box(2 * halfX, WALL_M), WALL));
        obstacles.add(obstacle(0, -outY, box(2 * halfX, WALL_M), WALL));
        for (int tile = 0; tile < columns * rows; tile++) {
            double x = left(tile);
            double y = bottom(tile);
            obstacles.add(obstacle(x + 4, y + 4, box(1, 0.3), WALL));
            obstacles.add(obstacle(x + 12, y + 4, box(0.3, 1), WALL));
            obstacles.add(obstacle(x + 4, y + 12, box(0.3, 1), WALL));
            obstacles.add(obstacle(x + 12, y + 12, box(1, 0.3), WALL));
            obstacles.add(obstacle(x + 8, y + 6, box(1, 0.3), WALL));
            obstacles.add(obstacle(x + 8, y + 10, box(0.3, 1), WALL));
            obstacles.add(obstacle(x + 6, y + 8, octagon(COLOURED_RADIUS_M), 0xFF0000));
            obstacles.add(obstacle(x + 10, y + 8, octagon(COLOURED_RADIUS_M), 0x00FF00));
            obstacles.add(obstacle(x + 8, y + 2, octagon(COLOURED_RADIUS_M), 0x0000FF));
        }
        return obstacles;
    }

    private double left(int tile) {
        return (tile % columns - columns / 2.0) * TILE_M;
    }

    private double bottom(int tile) {
        return (tile / columns - rows / 2.0) * TILE_M;
    }

    private static ObstacleSpec obstacle(double x, double y, Shape shape, int colour) {
        String name = "at " + x + " " + y;
        return new ObstacleSpec(name, new Pose(x, y, 0), shape, colour, true, true, true, NOWHERE);
    }

    private static Shape box(double lengthM, double widthM) {
        double x = lengthM / 2;
        double y = widthM / 2;
        return new Shape(List.of(List.of(new Point(-x, -y), new Point(x, -y), new Point(x, y), new Point(-x, y))));
    }

    private static Shape octagon(double radiusM) {
        return new Shape(List.of(IntStream.range(0, 8)
                .mapToObj(i -> i * StrictMath.PI / 4)
                .map(rad -> new Point(radiusM * StrictMath.cos(rad), radiusM * StrictMath.sin(rad)))
                .toList()));
    }
}
