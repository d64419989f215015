package io.troupe.sim;

import io.troupe.sim.device.Outline;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.IntFunction;
import org.jspecify.annotations.Nullable;

/**
 * Whether a robot can be put somewhere.
 *
 * <p><b>Threads.</b> Any thread: what stands still is never moved, and robots are placed anew for each question.
 */
final class Room {
    private record Obstacle(String title, Outline outline) {}

    private record Cell(long column, long row) {}

    private final List<RobotSpec> robots;
    private final List<Obstacle> obstacles = new ArrayList<>();
    private final double[] radiusM; // of a robot around its centre of rotation
    private final double cellM;

    Room(WorldSpec spec) {
        robots = spec.robots();
        for (ObstacleSpec obstacle : spec.obstacles()) {
            if (obstacle.blocksBodies()) {
                obstacles.add(new Obstacle(
                        "obstacle '" + obstacle.name() + "'", new Outline(obstacle.shape(), obstacle.pose())));
            }
        }
        radiusM = robots.stream().mapToDouble(Room::radiusM).toArray();
        cellM = 2 * Arrays.stream(radiusM).max().orElse(1);
    }

    private static double radiusM(RobotSpec robot) {
        return robot.collisionShape().polygons().stream()
                .flatMap(List::stream)
                .mapToDouble(vertex -> StrictMath.hypot(vertex.x(), vertex.y()))
                .max()
                .orElse(0);
    }

    /**
     * Sorts the robots by where they are, for any number of questions.
     *
     * @param poses where each of them is, asked again with every question
     */
    Occupancy occupancy(IntFunction<Pose> poses) {
        return new Occupancy(poses);
    }

    /**
     * Which robots are where, in square cells that are so wide that robots can only touch if their centres are in neighbouring ones.
     *
     * <p><b>Threads.</b> Any thread may ask; {@link #moved} belongs to the thread that made it, before others ask.
     */
    final class Occupancy {
        private final IntFunction<Pose> poses;
        private final Cell[] cellOf = new Cell[robots.size()];
        private final Map<Cell, List<Integer>> members = new HashMap<>();

        private Occupancy(IntFunction<Pose> poses) {
            this.poses = poses;
            for (int i = 0; i < cellOf.length; i++) {
                enter(i);
            }
        }

        private void enter(int robot) {
            if (robots.get(robot).blocksBodies()) {
                cellOf[robot] = cell(poses.apply(robot));
                members.computeIfAbsent(cellOf[robot], each -> new ArrayList<>(1))
                        .add(robot);
            }
        }

        private Cell cell(Pose pose) {
            return new Cell((long) Math.floor(pose.x() / cellM), (long) Math.floor(pose.y() / cellM));
        }

        /** Takes over that a robot has been put elsewhere. */
        void moved(int robot) {
            if (robots.get(robot).blocksBodies()) {
                members.get(cellOf[robot]).remove((Integer) robot);
                enter(robot);
            }
        }

        /** Why a robot cannot be at a pose, or null if it can. */
        @Nullable
        String refusal(int robot, Pose pose) {
            String attempt = "robot '" + robots.get(robot).name() + "' cannot be put at (" + pose.x() + " m, "
                    + pose.y() + " m, " + pose.headingRad() + " rad): ";
            if (!Double.isFinite(pose.x()) || !Double.isFinite(pose.y()) || !Double.isFinite(pose.headingRad())) {
                return attempt + "expected finite numbers";
            }
            for (List<Point> polygon : robots.get(robot).collisionShape().polygons()) {
                for (Point vertex : polygon) {
                    Point placed = pose.place(vertex);
                    if (Math.abs(placed.x()) > SpecCheck.FARTHEST_M || Math.abs(placed.y()) > SpecCheck.FARTHEST_M) {
                        return attempt + "expected at most " + SpecCheck.FARTHEST_M
                                + " m from the origin along x and y";
                    }
                }
            }
            if (!robots.get(robot).blocksBodies()) {
                return null;
            }
            var outline = new Outline(robots.get(robot).collisionShape(), pose);
            for (Obstacle obstacle : obstacles) {
                if (obstacle.outline().overlaps(outline)) {
                    return attempt + "it would overlap " + obstacle.title();
                }
            }
            int other = firstOverlapping(robot, pose, outline);
            return other < 0
                    ? null
                    : attempt + "it would overlap robot '" + robots.get(other).name() + "'";
        }

        /** The lowest index of a robot in the way, or -1. */
        private int firstOverlapping(int robot, Pose pose, Outline outline) {
            Cell at = cell(pose);
            int first = Integer.MAX_VALUE;
            for (long column = at.column() - 1; column <= at.column() + 1; column++) {
                for (long row = at.row() - 1; row <= at.row() + 1; row++) {
                    for (int other : members.getOrDefault(new Cell(column, row), List.of())) {
                        if (other != robot && other < first && overlaps(other, robot, pose, outline)) {
                            first = other;
                        }
                    }
                }
            }
            return first == Integer.MAX_VALUE ? -1 : first;
        }

        private boolean overlaps(int other, int robot, Pose pose, Outline outline) {
            Pose theirs = poses.apply(other);
            return StrictMath.hypot(theirs.x() - pose.x(), theirs.y() - pose.y()) <= radiusM[other] + radiusM[robot]
                    && new Outline(robots.get(other).collisionShape(), theirs).overlaps(outline);
        }
    }
}
