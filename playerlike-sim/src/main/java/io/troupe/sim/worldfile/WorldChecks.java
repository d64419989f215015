package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.lang.System.Logger.Level;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.stream.Stream;

/** Checks a world as a whole: unique names, distances from the origin, overlaps, robots outside the walls. */
final class WorldChecks {
    private static final double EXACT_WITHIN_M = 150;
    private static final double USABLE_WITHIN_M = 500;
    /** Farthest reach of an obstacle: rays still hit it, but no robot may start there. */
    private static final double WALLS_WITHIN_M = 5_000;

    /** A body at its place in the world. */
    private record Body(String name, SourcePosition where, List<List<Point>> pieces, Box box) {
        static Body of(RobotSpec robot) {
            return of("robot \"" + robot.name() + '"', robot.where(), robot.pose(), robot.collisionShape());
        }

        static Body of(ObstacleSpec obstacle) {
            return of("obstacle \"" + obstacle.name() + '"', obstacle.where(), obstacle.pose(), obstacle.shape());
        }

        private static Body of(String name, SourcePosition where, Pose pose, Shape shape) {
            List<List<Point>> pieces = shape.polygons().stream()
                    .map(polygon -> polygon.stream().map(pose::place).toList())
                    .toList();
            return new Body(name, where, pieces, Box.around(pieces));
        }

        boolean overlaps(Body other) {
            return box.meets(other.box)
                    && other.pieces.stream()
                            .filter(its -> box.meets(Box.around(List.of(its))))
                            .anyMatch(its -> pieces.stream().anyMatch(mine -> Polygons.overlap(mine, its)));
        }
    }

    private WorldChecks() {}

    static void check(WorldSpec world, Diagnostics diagnostics) {
        checkNames(world);
        List<Body> robots = world.robots().stream()
                .filter(RobotSpec::blocksBodies)
                .map(Body::of)
                .toList();
        List<Body> walls = world.obstacles().stream()
                .filter(ObstacleSpec::blocksBodies)
                .map(Body::of)
                .toList();
        Stream<Body> ghostRobots =
                world.robots().stream().filter(robot -> !robot.blocksBodies()).map(Body::of);
        Stream<Body> ghostWalls = world.obstacles().stream()
                .filter(obstacle -> !obstacle.blocksBodies())
                .map(Body::of);
        Stream.concat(robots.stream(), ghostRobots).forEach(body -> checkReach(body, USABLE_WITHIN_M));
        Stream.concat(walls.stream(), ghostWalls).forEach(body -> checkReach(body, WALLS_WITHIN_M));
        reportOverlaps(robots, walls, diagnostics);
        checkArena(world.robots(), walls, diagnostics);
    }

    private static void checkNames(WorldSpec world) {
        Map<String, SourcePosition> obstacles = new TreeMap<>();
        world.obstacles().forEach(obstacle -> obstacles.putIfAbsent(obstacle.name(), obstacle.where()));
        Map<String, SourcePosition> robots = new TreeMap<>();
        for (RobotSpec robot : world.robots()) {
            SourcePosition other = robots.put(robot.name(), robot.where());
            if (other == null) {
                other = obstacles.get(robot.name());
            }
            if (other != null) {
                throw new WorldFileException(
                        robot.where(), "the name \"" + robot.name() + "\" is already taken at " + other);
            }
        }
    }

    private static void checkReach(Body body, double limitM) {
        double reach = body.box.reach();
        if (reach > limitM) {
            throw new WorldFileException(
                    body.where,
                    body.name + " lies " + inMetres(reach) + " m from the origin along x or y; the limit is "
                            + (int) limitM + " m");
        }
        if (reach > EXACT_WITHIN_M) {
            System.getLogger(WorldChecks.class.getName())
                    .log(
                            Level.WARNING,
                            "{0}: {1} lies {2} m from the origin; beyond 150 m motion loses accuracy",
                            body.where,
                            body.name,
                            inMetres(reach));
        }
    }

    /** Reports overlaps. As in Stage, a robot that overlaps something cannot move; the simulator holds it. */
    private static void reportOverlaps(List<Body> robots, List<Body> walls, Diagnostics diagnostics) {
        for (int i = 0; i < robots.size(); i++) {
            Body robot = robots.get(i);
            Stream.concat(robots.subList(0, i).stream(), walls.stream())
                    .filter(robot::overlaps)
                    .forEach(other -> diagnostics.warn(
                            robot.where,
                            robot.name + " overlaps " + other.name + " (" + other.where
                                    + ") at the start: "
                                    + (robots.contains(other)
                                            ? "both stall, each until it is"
                                            : "it stalls until it is")
                                    + " put elsewhere"));
        }
    }

    private static void checkArena(List<RobotSpec> robots, List<Body> walls, Diagnostics diagnostics) {
        var pieces = new ArrayList<List<Point>>();
        walls.forEach(wall -> pieces.addAll(wall.pieces));
        Box arena = Box.around(pieces);
        Optional<RobotSpec> outside = robots.stream()
                .filter(robot -> !arena.holds(robot.pose().x(), robot.pose().y()))
                .findFirst();
        // separate obstacles in the open are no arena
        if (outside.isPresent() && Enclosure.isClosed(arena, pieces)) {
            RobotSpec robot = outside.get();
            diagnostics.refuse(
                    robot.where(),
                    "robot \"" + robot.name() + "\" at ("
                            + inMetres(robot.pose().x()) + ", "
                            + inMetres(robot.pose().y()) + ") stands outside the arena, whose walls reach " + arena);
        }
    }

    private static String inMetres(double metres) {
        return String.format(Locale.ROOT, "%.3f", metres);
    }

    /**
     * Distinguishes walls around a space from separate obstacles in the open, by a flood fill from outside over a grid
     * of cells.
     *
     * <p>A gap narrower than a cell, a hundredth of the extent, counts as closed.
     */
    private static final class Enclosure {
        private static final int CELLS = 100;

        private final Box extent;
        /** With one more row of cells on each side, from which the flood fill starts. */
        private final boolean[][] taken = new boolean[CELLS + 2][CELLS + 2];

        private Enclosure(Box extent) {
            this.extent = extent;
        }

        /** True if the extent contains free space that cannot be reached from outside. */
        static boolean isClosed(Box extent, List<List<Point>> convexPieces) {
            if (convexPieces.isEmpty()) {
                return false;
            }
            var enclosure = new Enclosure(extent);
            convexPieces.forEach(enclosure::markTaken);
            enclosure.flood();
            for (boolean[] column : enclosure.taken) {
                for (boolean cell : column) {
                    if (!cell) {
                        return true;
                    }
                }
            }
            return false;
        }

        private void markTaken(List<Point> piece) {
            double width = extent.width() / CELLS;
            double height = extent.height() / CELLS;
            Box box = Box.around(List.of(piece));
            int lastX = cell(box.maxX() - extent.minX(), width);
            int lastY = cell(box.maxY() - extent.minY(), height);
            for (int x = cell(box.minX() - extent.minX(), width); x <= lastX; x++) {
                for (int y = cell(box.minY() - extent.minY(), height); y <= lastY; y++) {
                    double left = extent.minX() + x * width;
                    double below = extent.minY() + y * height;
                    List<Point> cell = Polygons.rectangle(left, below, left + width, below + height);
                    if (!taken[x + 1][y + 1] && Polygons.overlap(piece, cell)) {
                        taken[x + 1][y + 1] = true;
                    }
                }
            }
        }

        private static int cell(double distance, double cellSize) {
            return Math.clamp((long) (distance / cellSize), 0, CELLS - 1);
        }

        private void flood() {
            var front = new ArrayDeque<int[]>();
            fill(front, 0, 0);
            while (!front.isEmpty()) {
                int[] cell = front.remove();
                fill(front, cell[0] - 1, cell[1]);
                fill(front, cell[0] + 1, cell[1]);
                fill(front, cell[0], cell[1] - 1);
                fill(front, cell[0], cell[1] + 1);
            }
        }

        private void fill(ArrayDeque<int[]> front, int x, int y) {
            boolean inside = x >= 0 && y >= 0 && x < CELLS + 2 && y < CELLS + 2;
            if (inside && !taken[x][y]) {
                taken[x][y] = true;
                front.add(new int[] {x, y});
            }
        }
    }
}
