package io.troupe.sim;

import io.troupe.sim.device.Outline;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.function.IntFunction;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Checks whether a robot or an obstacle can be placed at a pose.
 *
 * <p><b>Threads.</b> Any thread. The outline is computed for each check.
 */
final class PlacementCheck {
    private record Obstacle(String title, Outline outline) {}

    private record Cell(long column, long row) {}

    /** Stands for the number of an obstacle that stands still. */
    static final int NOT_A_MOVER = -1;

    /** Obstacles that cover more cells than this are in no cell; every check looks at them. */
    private static final int MOST_CELLS = 16;

    private final List<RobotSpec> robots;
    private final List<ObstacleSpec> movers;
    private final int[] moverNumbers; // of those that are there and block bodies
    private final List<Obstacle> obstacles = new ArrayList<>();
    private final List<Integer> largeObstacles = new ArrayList<>();
    private final Map<Cell, List<Integer>> smallObstacles = new HashMap<>();
    private final double[] radiusM; // of a robot around its centre of rotation
    private final double cellM;
    private final boolean[] away; // robots that are out of the world

    PlacementCheck(WorldSpec spec) {
        this(spec, new boolean[spec.robots().size()], new BitSet());
    }

    /**
     * @param away the robots that are out of the world
     * @param absentMovers those of the obstacles that may move, by their number among them
     */
    PlacementCheck(WorldSpec spec, boolean[] away, BitSet absentMovers) {
        this.away = away;
        robots = spec.robots();
        radiusM = robots.stream()
                .mapToDouble(robot -> radiusM(robot.collisionShape()))
                .toArray();
        cellM = 2 * Arrays.stream(radiusM).max().orElse(1);
        List<Integer> moving = spec.movingObstacles();
        moverNumbers = IntStream.range(0, moving.size())
                .filter(i -> !absentMovers.get(i)
                        && spec.obstacles().get(moving.get(i)).blocksBodies())
                .toArray();
        movers = moving.stream().map(spec.obstacles()::get).toList();
        for (int i = 0; i < spec.obstacles().size(); i++) {
            ObstacleSpec obstacle = spec.obstacles().get(i);
            if (obstacle.blocksBodies() && !moving.contains(i)) {
                enter(obstacles.size(), obstacle);
                obstacles.add(new Obstacle(
                        "obstacle '" + obstacle.name() + "'", new Outline(obstacle.shape(), obstacle.pose())));
            }
        }
    }

    private void enter(int index, ObstacleSpec obstacle) {
        double leastX = Double.POSITIVE_INFINITY;
        double leastY = Double.POSITIVE_INFINITY;
        double mostX = Double.NEGATIVE_INFINITY;
        double mostY = Double.NEGATIVE_INFINITY;
        for (List<Point> polygon : obstacle.shape().polygons()) {
            for (Point corner : polygon) {
                Point point = obstacle.pose().place(corner);
                leastX = Math.min(leastX, point.x());
                leastY = Math.min(leastY, point.y());
                mostX = Math.max(mostX, point.x());
                mostY = Math.max(mostY, point.y());
            }
        }
        Cell first = cell(leastX, leastY);
        Cell last = cell(mostX, mostY);
        double columns = (double) last.column() - first.column() + 1;
        double rows = (double) last.row() - first.row() + 1;
        if (columns * rows > MOST_CELLS) {
            largeObstacles.add(index);
            return;
        }
        for (long column = first.column(); column <= last.column(); column++) {
            for (long row = first.row(); row <= last.row(); row++) {
                smallObstacles
                        .computeIfAbsent(new Cell(column, row), each -> new ArrayList<>(1))
                        .add(index);
            }
        }
    }

    private Cell cell(double x, double y) {
        return new Cell((long) Math.floor(x / cellM), (long) Math.floor(y / cellM));
    }

    /** Lowest index of an overlapping obstacle, or -1. */
    private int firstObstacle(Pose pose, Outline outline) {
        for (int index : obstaclesNear(pose)) {
            if (obstacles.get(index).outline().overlaps(outline)) {
                return index;
            }
        }
        return -1;
    }

    /** Indices of the obstacles that a robot at this pose might touch, in ascending order. */
    Set<Integer> obstaclesNear(Pose pose) {
        var near = new TreeSet<>(largeObstacles);
        Cell at = cell(pose.x(), pose.y());
        for (long column = at.column() - 1; column <= at.column() + 1; column++) {
            for (long row = at.row() - 1; row <= at.row() + 1; row++) {
                near.addAll(smallObstacles.getOrDefault(new Cell(column, row), List.of()));
            }
        }
        return near;
    }

    private static double radiusM(Shape shape) {
        return shape.polygons().stream()
                .flatMap(List::stream)
                .mapToDouble(vertex -> StrictMath.hypot(vertex.x(), vertex.y()))
                .max()
                .orElse(0);
    }

    private static String attempt(String what, Pose pose) {
        return what + " cannot be put at (" + pose.x() + " m, " + pose.y() + " m, " + pose.headingRad() + " rad): ";
    }

    /** What is expected of the pose of a body and is not so, or null. */
    private static @Nullable String problem(Pose pose, List<List<Point>> lines) {
        if (!Double.isFinite(pose.x()) || !Double.isFinite(pose.y()) || !Double.isFinite(pose.headingRad())) {
            return "expected finite numbers";
        }
        boolean near = lines.stream()
                .flatMap(List::stream)
                .map(pose::place)
                .allMatch(placed ->
                        Math.abs(placed.x()) <= SpecCheck.FARTHEST_M && Math.abs(placed.y()) <= SpecCheck.FARTHEST_M);
        return near ? null : "expected at most " + SpecCheck.FARTHEST_M + " m from the origin along x and y";
    }

    /**
     * Sorts the robots into cells, for any number of checks.
     *
     * @param poses pose of each robot and, after the robots, of each obstacle that moves; read again at every check
     */
    Occupancy occupancy(IntFunction<Pose> poses) {
        return new Occupancy(poses);
    }

    /**
     * Index of the robots by cell. Cells are square and so wide that robots can touch only if their centres are in the
     * same or in neighbouring cells.
     *
     * <p><b>Threads.</b> Any thread may check. {@link #moved} belongs to the thread that created the index, before
     * other threads use it.
     */
    final class Occupancy {
        private final IntFunction<Pose> poses;
        private final @Nullable Cell[] cellOf = new Cell[robots.size()];
        private final Map<Cell, List<Integer>> members = new HashMap<>();

        private Occupancy(IntFunction<Pose> poses) {
            this.poses = poses;
            for (int i = 0; i < cellOf.length; i++) {
                if (!away[i]) {
                    enter(i);
                }
            }
        }

        private void enter(int robot) {
            if (robots.get(robot).blocksBodies()) {
                Pose pose = poses.apply(robot);
                cellOf[robot] = cell(pose.x(), pose.y());
                members.computeIfAbsent(cellOf[robot], each -> new ArrayList<>(1))
                        .add(robot);
            }
        }

        /** Updates the cell of a robot that has been teleported, or has come back. */
        void moved(int robot) {
            if (robots.get(robot).blocksBodies()) {
                if (cellOf[robot] != null) {
                    members.get(cellOf[robot]).remove((Integer) robot);
                }
                enter(robot);
            }
        }

        /** Reason why a robot cannot be at a pose, or null if it can. */
        @Nullable
        String refusal(int robot, Pose pose) {
            String attempt = attempt("robot '" + robots.get(robot).name() + "'", pose);
            String problem = problem(pose, robots.get(robot).collisionShape().polygons());
            if (problem != null) {
                return attempt + problem;
            }
            if (!robots.get(robot).blocksBodies()) {
                return null;
            }
            var outline = new Outline(robots.get(robot).collisionShape(), pose);
            int obstacle = firstObstacle(pose, outline);
            if (obstacle >= 0) {
                return attempt + "it would overlap " + obstacles.get(obstacle).title();
            }
            int mover = firstMover(outline, NOT_A_MOVER);
            if (mover >= 0) {
                return attempt + "it would overlap obstacle '"
                        + movers.get(mover).name() + "'";
            }
            int other = firstOverlapping(robot, pose, outline);
            return other < 0
                    ? null
                    : attempt + "it would overlap robot '" + robots.get(other).name() + "'";
        }

        /** Lowest number of an overlapping obstacle that moves, or -1. */
        private int firstMover(Outline outline, int except) {
            for (int mover : moverNumbers) {
                if (mover != except
                        && new Outline(movers.get(mover).shape(), poses.apply(robots.size() + mover))
                                .overlaps(outline)) {
                    return mover;
                }
            }
            return -1;
        }

        /**
         * Reason why an obstacle cannot be at a pose, or null if it can. One that moves must not overlap anything; one
         * that stands still may overlap others that stand still.
         *
         * @param mover its number if it moves, or {@link #NOT_A_MOVER}
         */
        @Nullable
        String refusal(ObstacleSpec obstacle, int mover, Pose pose) {
            String attempt = attempt("obstacle '" + obstacle.name() + "'", pose);
            String problem = problem(pose, obstacle.shape().outlines());
            if (problem != null) {
                return attempt + problem;
            }
            var outline = new Outline(obstacle.shape(), pose);
            if (!obstacle.blocksBodies()) {
                return null;
            }
            double reachM = radiusM(obstacle.shape());
            for (int robot = 0; robot < cellOf.length; robot++) {
                if (cellOf[robot] != null && overlaps(robot, reachM, pose, outline)) {
                    return attempt + "it would overlap robot '"
                            + robots.get(robot).name() + "'";
                }
            }
            int other = firstMover(outline, mover);
            if (other >= 0) {
                return attempt + "it would overlap obstacle '"
                        + movers.get(other).name() + "'";
            }
            for (Obstacle each : mover == NOT_A_MOVER ? List.<Obstacle>of() : obstacles) {
                if (each.outline().overlaps(outline)) {
                    return attempt + "it would overlap " + each.title();
                }
            }
            return null;
        }

        /** Lowest index of an overlapping robot, or -1. */
        private int firstOverlapping(int robot, Pose pose, Outline outline) {
            Cell at = cell(pose.x(), pose.y());
            int first = Integer.MAX_VALUE;
            for (long column = at.column() - 1; column <= at.column() + 1; column++) {
                for (long row = at.row() - 1; row <= at.row() + 1; row++) {
                    for (int other : members.getOrDefault(new Cell(column, row), List.of())) {
                        if (other != robot && other < first && overlaps(other, radiusM[robot], pose, outline)) {
                            first = other;
                        }
                    }
                }
            }
            return first == Integer.MAX_VALUE ? -1 : first;
        }

        private boolean overlaps(int other, double reachM, Pose pose, Outline outline) {
            Pose theirs = poses.apply(other);
            return StrictMath.hypot(theirs.x() - pose.x(), theirs.y() - pose.y()) <= radiusM[other] + reachM
                    && new Outline(robots.get(other).collisionShape(), theirs).overlaps(outline);
        }
    }
}
