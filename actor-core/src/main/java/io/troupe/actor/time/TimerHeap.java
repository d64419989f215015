package io.troupe.actor.time;

import java.util.Arrays;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Timers ordered by deadline, then by creation: a heap with four children per node, in which each timer stores its
 * index.
 *
 * <p><b>Cost.</b> Logarithmic time for adding and removing.
 */
class TimerHeap {
    private static final int SMALL = 16;
    private static final int CHILDREN = 4;

    private @Nullable Timer[] timers = new Timer[SMALL];
    private int size;

    /** The number of timers. */
    final int size() {
        return size;
    }

    /** The earliest timer, or null. */
    final @Nullable Timer first() {
        return timers[0];
    }

    /** True if a timer runs before another one; the only place where timers are compared. */
    boolean isEarlier(Timer timer, Timer other) {
        return timer.deadlineNanos < other.deadlineNanos
                || timer.deadlineNanos == other.deadlineNanos && timer.sequence < other.sequence;
    }

    /*
     * A stack overflow of the caller in here must not corrupt the heap. A call may overflow, a store cannot: between
     * two calls the heap is complete, and at worst a timer is out of order.
     */

    final void add(Timer timer) {
        if (size == timers.length) {
            timers = Arrays.copyOf(timers, 2 * size);
        }
        timers[size] = timer;
        timer.place = size++;
        moveUp(timer);
    }

    /** Removes a timer that is in the heap. */
    final void remove(Timer timer) {
        Timer last = at(size - 1);
        size--;
        timers[size] = null;
        if (last != timer) {
            timers[timer.place] = last;
            last.place = timer.place;
        }
        timer.place = Timer.NOWHERE;
        if (last != timer) {
            moveDown(last);
            moveUp(last);
        }
        if (size < timers.length / 4 && timers.length > SMALL) {
            timers = Arrays.copyOf(timers, timers.length / 2);
        }
    }

    private Timer at(int place) {
        return Objects.requireNonNull(timers[place]);
    }

    private void moveUp(Timer timer) {
        while (timer.place > 0) {
            Timer parent = at((timer.place - 1) >>> 2);
            if (!isEarlier(timer, parent)) {
                return;
            }
            int place = parent.place;
            timers[timer.place] = parent;
            parent.place = timer.place;
            timers[place] = timer;
            timer.place = place;
        }
    }

    private void moveDown(Timer timer) {
        for (Timer child = earliestChild(timer); child != null; child = earliestChild(timer)) {
            if (!isEarlier(child, timer)) {
                return;
            }
            int place = child.place;
            timers[timer.place] = child;
            child.place = timer.place;
            timers[place] = timer;
            timer.place = place;
        }
    }

    private @Nullable Timer earliestChild(Timer timer) {
        int first = (timer.place << 2) + 1;
        Timer earliest = first < size ? at(first) : null;
        for (int place = first + 1; earliest != null && place < Math.min(first + CHILDREN, size); place++) {
            Timer child = at(place);
            if (isEarlier(child, earliest)) {
                earliest = child;
            }
        }
        return earliest;
    }
}
