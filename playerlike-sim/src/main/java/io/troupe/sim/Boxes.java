package io.troupe.sim;

import io.troupe.sim.model.ColouredBox;
import java.util.ArrayList;
import java.util.List;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/**
 * The boxes of a world, and their changes, which wait for the next interval.
 *
 * <p><b>Threads.</b> Changes from any thread; {@link #apply} and {@link #clear} belong to the thread that advances the
 * world.
 */
final class Boxes {
    /** @param box null = it is to be removed */
    private record Change(int number, @Nullable ColouredBox box) {}

    private final SortedMap<Integer, ColouredBox> boxes = new TreeMap<>();
    private final List<Change> pending = new ArrayList<>(); // guarded by itself
    private volatile boolean hasPending;

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

    /** True if changes wait. Looking allocates nothing. */
    boolean hasPending() {
        return hasPending;
    }

    /**
     * Makes the changes that wait.
     *
     * @param refusals the reason why a box cannot be where it is, or null
     * @return false if nothing has changed
     */
    boolean apply(long tick, Function<ColouredBox, @Nullable String> refusals, @Nullable Recording recording) {
        boolean changed = false;
        for (Change change : takePending()) {
            ColouredBox box = change.box();
            String refusal = box == null ? null : refusals.apply(box);
            if (refusal != null) {
                System.getLogger(World.class.getName())
                        .log(System.Logger.Level.WARNING, "at tick " + tick + " " + refusal);
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
