package io.troupe.sim;

import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import java.util.List;

/**
 * The state of the whole world at a tick; immutable.
 *
 * @param tick 0 before the first interval
 * @param timeMicros simulated time
 * @param robots by index, in the order of the world file
 * @param contacts that began in the interval that ends at this tick, ordered by time, then robot; for one robot other
 *     robots come before obstacles, each in the order of the world file
 * @param moved where the obstacles are that can move, in the order of {@link WorldSpec#movingObstacles}
 * @param boxes that have been put into the world, by number
 */
public record Snapshot(
        long tick,
        long timeMicros,
        List<RobotReading> robots,
        List<Contact> contacts,
        List<Pose> moved,
        List<ColouredBox> boxes) {
    public Snapshot {
        robots = List.copyOf(robots);
        contacts = List.copyOf(contacts);
        moved = List.copyOf(moved);
        boxes = List.copyOf(boxes);
    }

    /** A snapshot of a world without boxes, in which no obstacle moves. */
    public Snapshot(long tick, long timeMicros, List<RobotReading> robots, List<Contact> contacts) {
        this(tick, timeMicros, robots, contacts, List.of(), List.of());
    }
}
