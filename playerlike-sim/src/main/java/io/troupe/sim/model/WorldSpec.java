package io.troupe.sim.model;

import java.nio.file.Path;
import java.util.List;
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
}
