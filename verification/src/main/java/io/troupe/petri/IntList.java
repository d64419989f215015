package io.troupe.petri;

import java.util.Arrays;

/** A growing list of ints. */
final class IntList {
    /** The longest array that every virtual machine makes. */
    private static final int MAX_LENGTH = Integer.MAX_VALUE - 8;

    private int[] values;
    private int size;

    IntList() {
        this(64);
    }

    IntList(int capacity) {
        values = new int[capacity];
    }

    void add(int value) {
        if (size == values.length) {
            if (size == MAX_LENGTH) {
                throw new OutOfMemoryError("a list of " + size + " numbers"); // the search ends with what it has
            }
            values = Arrays.copyOf(values, grown());
        }
        values[size++] = value;
    }

    private int grown() {
        return (int) Math.min(MAX_LENGTH, size + Math.max(4L, size >> 1));
    }

    /** What it takes while {@code more} values are added, the copy at its growing included. */
    long bytesWith(int more) {
        var grows = values.length - size < more;
        return Integer.BYTES * (values.length + (grows ? Math.max(grown(), (long) size + more) : 0L));
    }

    int get(int index) {
        return values[index];
    }

    int size() {
        return size;
    }

    int[] toArray() {
        return Arrays.copyOf(values, size);
    }
}
