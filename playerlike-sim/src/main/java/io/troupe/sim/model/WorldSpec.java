package io.troupe.sim.model;

import java.nio.file.Path;
import java.util.List;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/**
 * The description of a world, as read from its file.
 *
 * @param file the file from which it was read
 * @param intervalMillis simulated time between two publications of sensor data ({@code interval_sim})
 * @param robots in the order of the file
 * @param obstacles in the order of the file
 */
public record WorldSpec(
        String name, Path file, int intervalMillis, List<RobotSpec> robots, List<ObstacleSpec> obstacles) {
    public WorldSpec {
        robots = List.copyOf(robots);
        obstacles = List.copyOf(obstacles);
    }

    /** This world with boxes, which follow its other obstacles. */
    public WorldSpec with(List<ColouredBox> boxes) {
        return boxes.isEmpty()
                ? this
                : new WorldSpec(
                        name,
                        file,
                        intervalMillis,
                        robots,
                        Stream.concat(obstacles.stream(), boxes.stream().map(ColouredBox::obstacle))
                                .toList());
    }

    /**
     * Indices of the obstacles that may move, in ascending order: those that can be pushed and, in a world with a
     * gripper, those that it can take.
     */
    public List<Integer> movingObstacles() {
        boolean hasGripper = robots.stream()
                .anyMatch(robot -> robot.devices().stream().anyMatch(DeviceSpec.Gripper.class::isInstance));
        return IntStream.range(0, obstacles.size())
                .filter(i -> isPushed(obstacles.get(i))
                        || hasGripper && obstacles.get(i).traits().grippable())
                .boxed()
                .toList();
    }

    private static boolean isPushed(ObstacleSpec obstacle) {
        return obstacle.traits().pushableKg() > 0 && obstacle.blocksBodies();
    }
}
