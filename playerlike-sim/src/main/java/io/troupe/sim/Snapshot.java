package io.troupe.sim;

import java.util.List;

/**
 * The state of the whole world at a tick; immutable.
 *
 * @param tick 0 before the first interval
 * @param timeMicros simulated time
 * @param robots by index, in the order of the world file
 * @param contacts that began in the interval that ends at this tick, ordered by time, then robot; for one robot other
 *     robots come before obstacles, each in the order of the world file
 */
public record Snapshot(long tick, long timeMicros, List<RobotReading> robots, List<Contact> contacts) {
    public Snapshot {
        robots = List.copyOf(robots);
        contacts = List.copyOf(contacts);
    }
}
