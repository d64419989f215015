package io.troupe.actor.internal;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/**
 * A queue with a capacity, first in, first out. When it is full, one more element either takes the place of the oldest
 * one or is rejected. Internal to this library.
 *
 * <p><b>Threads.</b> One at a time: its user's lock guards it.
 */
public final class BoundedQueue<E> {
    private final ArrayDeque<E> elements = new ArrayDeque<>();
    private final int capacity;
    private final boolean dropsOldest;

    private BoundedQueue(int capacity, boolean dropsOldest) {
        if (capacity < 1) {
            throw new IllegalArgumentException("capacity is " + capacity + ", expected 1 or more");
        }
        this.capacity = capacity;
        this.dropsOldest = dropsOldest;
    }

    /** A queue that keeps the newest elements. */
    public static <E> BoundedQueue<E> droppingOldest(int capacity) {
        return new BoundedQueue<>(capacity, true);
    }

    /** A queue that keeps the elements that it has. */
    public static <E> BoundedQueue<E> rejecting(int capacity) {
        return new BoundedQueue<>(capacity, false);
    }

    /**
     * Adds an element, if there is room or room can be made.
     *
     * @return the element for which there is no room: the oldest one, or the new one; null if there was room
     */
    public @Nullable E offer(E element) {
        E noRoom = null;
        if (elements.size() >= capacity) {
            if (!dropsOldest) {
                return element;
            }
            noRoom = elements.pollFirst();
        }
        elements.addLast(element);
        return noRoom;
    }

    /** Adds an element for which there is always room: the end of a stream. */
    public void offerEnd(E element) {
        elements.addLast(element);
    }

    /** Removes and returns the oldest element, or null. */
    public @Nullable E poll() {
        return elements.pollFirst();
    }

    public @Nullable E peek() {
        return elements.peekFirst();
    }

    public @Nullable E peekLast() {
        return elements.peekLast();
    }

    /** Removes and returns all elements, the oldest first. */
    public List<E> drain() {
        List<E> all = new ArrayList<>(elements);
        elements.clear();
        return all;
    }

    public boolean removeIf(Predicate<? super E> condition) {
        return elements.removeIf(condition);
    }

    /** Removes the newest of these elements. */
    public void removeLast(E element) {
        elements.removeLastOccurrence(element);
    }

    /**
     * The number of elements ahead of the first one that meets a condition, of the first {@code most}; otherwise -1.
     */
    public int placeOf(Predicate<? super E> condition, int most) {
        int place = 0;
        for (E each : elements) {
            if (place == most) {
                break;
            }
            if (condition.test(each)) {
                return place;
            }
            place++;
        }
        return -1;
    }

    public int size() {
        return elements.size();
    }

    public boolean isEmpty() {
        return elements.isEmpty();
    }
}
