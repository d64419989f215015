package io.troupe.sim;

import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.Collections;
import java.util.List;
import java.util.Optional;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Which robots and obstacles are in a world now, and where the obstacles are. Indices never change: what is away has
 * left its place empty.
 *
 * <p><b>Threads.</b> Any thread may demand changes of obstacles; the rest belongs to the thread that advances the
 * world.
 */
final class WorldContents {
    private static final SortedMap<Integer, Optional<Pose>> NO_DEMANDS = Collections.emptySortedMap();

    private final WorldSpec spec;
    private final List<Integer> movers; // indices of the obstacles that may move
    private final boolean[] away; // by robot
    private final List<@Nullable ObstacleSpec> obstacles; // null = away
    private final SortedMap<Integer, Optional<Pose>> placed = new TreeMap<>(); // those that are not as at the start
    private List<ColouredBox> boxes = List.of();
    private final SortedMap<Integer, Optional<Pose>> demanded = new TreeMap<>(); // empty = take away
    private volatile boolean hasDemands;

    WorldContents(WorldSpec spec) {
        this.spec = spec;
        movers = spec.movingObstacles();
        away = new boolean[spec.robots().size()];
        obstacles = new ArrayList<>(spec.obstacles());
    }

    /** Returns to the start, where everything is as in the specification. Returns false if it was so already. */
    boolean begin() {
        boolean same = placed.isEmpty() && !anyAway() && boxes.isEmpty();
        boxes = List.of();
        placed.clear();
        Arrays.fill(away, false);
        obstacles.clear();
        obstacles.addAll(spec.obstacles());
        return !same;
    }

    // ---- from any thread

    /** Puts an obstacle at a pose when the next interval begins, or takes it away if that is null. */
    void demand(int obstacle, @Nullable Pose pose) {
        checkObstacle(obstacle);
        synchronized (demanded) {
            demanded.put(obstacle, Optional.ofNullable(pose));
            hasDemands = true;
        }
    }

    void checkObstacle(int obstacle) {
        if (obstacle < 0 || obstacle >= spec.obstacles().size()) {
            throw new IllegalArgumentException("there is no obstacle " + obstacle + ", world '" + spec.name() + "' has "
                    + spec.obstacles().size() + ", counted from 0");
        }
    }

    void forgetDemands() {
        synchronized (demanded) {
            demanded.clear();
            hasDemands = false;
        }
    }

    // ---- from the thread that advances the world

    /** The newest demand for each obstacle that has one, by index; empty = take away. */
    SortedMap<Integer, Optional<Pose>> takeDemands() {
        if (!hasDemands) {
            return NO_DEMANDS;
        }
        synchronized (demanded) {
            var taken = new TreeMap<>(demanded);
            forgetDemands();
            return taken;
        }
    }

    void setAway(int robot, boolean isAway) {
        away[robot] = isAway;
    }

    boolean isAway(int robot) {
        return away[robot];
    }

    boolean anyAway() {
        for (boolean each : away) {
            if (each) {
                return true;
            }
        }
        return false;
    }

    /** Indices of the robots that are away. */
    List<Integer> awayRobots() {
        return anyAway()
                ? IntStream.range(0, away.length).filter(this::isAway).boxed().toList()
                : List.of();
    }

    /** The obstacles that are not as at the start, by index; empty = away. */
    SortedMap<Integer, Optional<Pose>> placedObstacles() {
        return placed;
    }

    /** True if the obstacle is in the world. */
    boolean holds(int obstacle) {
        return obstacles.get(obstacle) != null;
    }

    void remove(int obstacle) {
        obstacles.set(obstacle, null);
        placed.put(obstacle, Optional.empty());
    }

    void place(int obstacle, Pose pose) {
        ObstacleSpec start = spec.obstacles().get(obstacle);
        obstacles.set(obstacle, start.at(pose));
        if (pose.equals(start.pose())) {
            placed.remove(obstacle);
        } else {
            placed.put(obstacle, Optional.of(pose));
        }
    }

    /** An obstacle that may move is in the world. Where it is does not matter here. */
    void show(int obstacle) {
        obstacles.set(obstacle, spec.obstacles().get(obstacle));
        placed.remove(obstacle);
    }

    /** Puts these boxes into the world, instead of those that are there. */
    void furnish(List<ColouredBox> all) {
        boxes = all;
    }

    /** The obstacles by index, those that are away where they were at the start; then the boxes. */
    WorldSpec furnished() {
        List<ObstacleSpec> all = new ArrayList<>();
        for (int i = 0; i < obstacles.size(); i++) {
            ObstacleSpec there = obstacles.get(i);
            all.add(there == null ? spec.obstacles().get(i) : there);
        }
        boxes.forEach(box -> all.add(box.obstacle()));
        return new WorldSpec(spec.name(), spec.file(), spec.intervalMillis(), spec.robots(), all);
    }

    /**
     * What can be sensed now: the obstacles that are there, and all robots and all obstacles that may move, of which
     * nothing senses those away.
     */
    WorldSpec sensed() {
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < away.length; i++) {
            robots.add(away[i] ? spec.robots().get(i).unseen() : spec.robots().get(i));
        }
        return new WorldSpec(spec.name(), spec.file(), spec.intervalMillis(), robots, there());
    }

    /** The check of places among what is there now. */
    PlacementCheck placement() {
        BitSet absentMovers = new BitSet();
        for (int i = 0; i < movers.size(); i++) {
            absentMovers.set(i, !holds(movers.get(i)));
        }
        return new PlacementCheck(
                new WorldSpec(spec.name(), spec.file(), spec.intervalMillis(), spec.robots(), there()),
                away.clone(),
                absentMovers);
    }

    private List<ObstacleSpec> there() {
        List<ObstacleSpec> there = new ArrayList<>();
        for (int i = 0; i < obstacles.size(); i++) {
            ObstacleSpec obstacle = obstacles.get(i);
            if (obstacle != null) {
                there.add(obstacle);
            } else if (movers.contains(i)) { // they are known by their order
                there.add(spec.obstacles().get(i));
            }
        }
        boxes.forEach(box -> there.add(box.obstacle()));
        return there;
    }
}
