package io.troupe.sim;

import io.troupe.sim.device.Outline;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.function.IntFunction;
import org.jspecify.annotations.Nullable;

/**
 * Whether a robot can be put somewhere.
 *
 * <p><b>Threads.</b> Any thread: what stands still is never moved, and robots are placed anew for each question.
 */
final class Room {
    private record Obstacle(String title, Outline outline) {}

    private final List<RobotSpec> robots;
    private final List<Obstacle> obstacles = new ArrayList<>();

    Room(WorldSpec spec) {
        robots = spec.robots();
        for (ObstacleSpec obstacle : spec.obstacles()) {
            if (obstacle.blocksBodies()) {
                obstacles.add(new Obstacle(
                        "obstacle '" + obstacle.name() + "'", new Outline(obstacle.shape(), obstacle.pose())));
            }
        }
    }

    /**
     * Why a robot cannot be at a pose, or null if it can.
     *
     * @param others where the robots are
     */
    @Nullable
    String refusal(int robot, Pose pose, IntFunction<Pose> others) {
        String attempt = "robot '" + robots.get(robot).name() + "' cannot be put at (" + pose.x() + " m, " + pose.y()
                + " m, " + pose.headingRad() + " rad): ";
        if (!Double.isFinite(pose.x()) || !Double.isFinite(pose.y()) || !Double.isFinite(pose.headingRad())) {
            return attempt + "expected finite numbers";
        }
        for (List<Point> polygon : robots.get(robot).shape().polygons()) {
            for (Point vertex : polygon) {
                Point placed = pose.place(vertex);
                if (Math.abs(placed.x()) > SpecCheck.FARTHEST_M || Math.abs(placed.y()) > SpecCheck.FARTHEST_M) {
                    return attempt + "expected at most " + SpecCheck.FARTHEST_M + " m from the origin along x and y";
                }
            }
        }
        var outline = new Outline(robots.get(robot).shape(), pose);
        for (Obstacle obstacle : obstacles) {
            if (obstacle.outline().overlaps(outline)) {
                return attempt + "it would overlap " + obstacle.title();
            }
        }
        for (int i = 0; i < robots.size(); i++) {
            if (i != robot && new Outline(robots.get(i).shape(), others.apply(i)).overlaps(outline)) {
                return attempt + "it would overlap robot '" + robots.get(i).name() + "'";
            }
        }
        return null;
    }
}
