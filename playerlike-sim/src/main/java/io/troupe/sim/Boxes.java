package io.troupe.sim;

import io.troupe.sim.device.Outline;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.function.IntFunction;
import org.jspecify.annotations.Nullable;

/**
 * The boxes of a world, and their changes, which wait for the next interval.
 *
 * <p><b>Threads.</b> Changes from any thread; {@link #apply} and {@link #clear} belong to the thread that advances the
 * world.
 */
final class Boxes {
    private static final System.Logger LOG = System.getLogger(World.class.getName());

    /** @param box null = it is to be removed */
    private record Change(int number, @Nullable ColouredBox box) {}

    private final WorldSpec spec;
    private final SortedMap<Integer, ColouredBox> boxes = new TreeMap<>();
    private final List<Change> pending = new ArrayList<>(); // guarded by itself
    private volatile boolean hasPending;

    Boxes(WorldSpec spec) {
        this.spec = spec;
    }

    void put(ColouredBox box) {
        add(new Change(box.number(), box));
    }

    void remove(int number) {
        add(new Change(number, null));
    }

    private void add(Change change) {
        synchronized (pending) {
            pending.add(change);
            hasPending = true;
        }
    }

    void forgetPending() {
        synchronized (pending) {
            pending.clear();
            hasPending = false;
        }
    }

    private List<Change> takePending() {
        synchronized (pending) {
            var taken = List.copyOf(pending);
            forgetPending();
            return taken;
        }
    }

    /** Reason why a box cannot be where it is, or null. */
    @Nullable
    String refusal(ColouredBox box, IntFunction<Pose> poses) {
        String attempt = box.name() + " cannot be put at (" + box.x() + " m, " + box.y() + " m): ";
        double farthest = Math.max(Math.abs(box.x()), Math.abs(box.y())) + ColouredBox.SIDE_M;
        if (farthest > SpecCheck.FARTHEST_M) {
            return attempt + "expected at most " + SpecCheck.FARTHEST_M + " m from the origin along x and y";
        }
        ObstacleSpec obstacle = box.obstacle();
        var outline = new Outline(obstacle.shape(), obstacle.pose());
        for (int i = 0; i < spec.robots().size(); i++) {
            RobotSpec robot = spec.robots().get(i);
            if (robot.blocksBodies() && isNear(robot, poses.apply(i), box)) {
                if (new Outline(robot.collisionShape(), poses.apply(i)).overlaps(outline)) {
                    return attempt + "it would overlap robot '" + robot.name() + "'";
                }
            }
        }
        return null;
    }

    private static boolean isNear(RobotSpec robot, Pose pose, ColouredBox box) {
        double reachM = robot.collisionShape().polygons().stream()
                .flatMap(List::stream)
                .mapToDouble(vertex -> StrictMath.hypot(vertex.x(), vertex.y()))
                .max()
                .orElse(0);
        return StrictMath.hypot(pose.x() - box.x(), pose.y() - box.y()) <= reachM + ColouredBox.SIDE_M;
    }

    /** True if changes wait. Looking allocates nothing. */
    boolean hasPending() {
        return hasPending;
    }

    /**
     * Makes the changes that wait.
     *
     * @return false if nothing has changed
     */
    boolean apply(long tick, IntFunction<Pose> poses, @Nullable Recording recording) {
        boolean changed = false;
        for (Change change : takePending()) {
            ColouredBox box = change.box();
            String refusal = box == null ? null : refusal(box, poses);
            if (refusal != null) {
                LOG.log(System.Logger.Level.WARNING, "at tick " + tick + " " + refusal);
            } else if (box == null
                    ? boxes.remove(change.number()) != null
                    : !box.equals(boxes.put(box.number(), box))) {
                changed = true;
                if (recording != null) {
                    recording.box(change.number(), box);
                }
            }
        }
        return changed;
    }

    /** Removes all boxes. */
    void clear() {
        boxes.clear();
    }

    List<ColouredBox> all() {
        return List.copyOf(boxes.values());
    }
}
