package io.troupe.sim;

import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import java.util.Collections;
import java.util.List;
import java.util.Optional;
import java.util.SortedMap;
import java.util.TreeMap;

/**
 * The state of the whole world at a tick; immutable.
 *
 * @param tick 0 before the first interval
 * @param timeMicros simulated time
 * @param robots by index, in the order of the world file
 * @param contacts that began in the interval that ends at this tick, ordered by time, then robot; for one robot other
 *     robots come before obstacles, each in the order of the world file
 * @param moved where the obstacles are that can move, in the order of {@link WorldSpec#movingObstacles}; of one that
 *     was taken out, where it was last
 * @param boxes that have been put into the world, by number
 * @param placed the obstacles that were put elsewhere or taken out, by index: where they are, empty = taken out; of
 *     those that can move only the latter
 * @param away indices of the robots that were taken out, in ascending order
 * @param held the obstacles that grippers hold, by index: the index of the robot
 */
public record Snapshot(
        long tick,
        long timeMicros,
        List<RobotReading> robots,
        List<Contact> contacts,
        List<Pose> moved,
        List<ColouredBox> boxes,
        SortedMap<Integer, Optional<Pose>> placed,
        List<Integer> away,
        SortedMap<Integer, Integer> held) {
    public Snapshot {
        robots = List.copyOf(robots);
        contacts = List.copyOf(contacts);
        moved = List.copyOf(moved);
        boxes = List.copyOf(boxes);
        placed = copy(placed);
        away = List.copyOf(away);
        held = copy(held);
    }

    private static <V> SortedMap<Integer, V> copy(SortedMap<Integer, V> map) {
        return map.isEmpty() ? Collections.emptySortedMap() : Collections.unmodifiableSortedMap(new TreeMap<>(map));
    }

    /** A snapshot of a world without boxes, in which no obstacle moves, and nothing comes or goes. */
    public Snapshot(long tick, long timeMicros, List<RobotReading> robots, List<Contact> contacts) {
        this(tick, timeMicros, robots, contacts, List.of(), Collections.emptySortedMap());
    }

    /**
     * A snapshot of a world without boxes, in which nothing comes or goes.
     *
     * @param moved where the obstacles are that can move
     * @param held the obstacles that grippers hold, by index: the index of the robot
     */
    public Snapshot(
            long tick,
            long timeMicros,
            List<RobotReading> robots,
            List<Contact> contacts,
            List<Pose> moved,
            SortedMap<Integer, Integer> held) {
        this(tick, timeMicros, robots, contacts, moved, List.of(), Collections.emptySortedMap(), List.of(), held);
    }

    /**
     * The obstacles that are not where the world file has them, by index: where they are, empty = taken out.
     *
     * @param world of this snapshot
     */
    public SortedMap<Integer, Optional<Pose>> displaced(WorldSpec world) {
        if (moved.isEmpty()) {
            return placed;
        }
        var displaced = new TreeMap<>(placed);
        List<Integer> movers = world.movingObstacles();
        for (int i = 0; i < moved.size(); i++) {
            Pose pose = moved.get(i);
            boolean isThere = !placed.containsKey(movers.get(i));
            if (isThere && !pose.equals(world.obstacles().get(movers.get(i)).pose())) {
                displaced.put(movers.get(i), Optional.of(pose));
            }
        }
        return displaced;
    }
}
