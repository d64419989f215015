package io.troupe.petri;

import java.util.Arrays;

/** A growable list of ints. */
final class IntList {
    /** The largest array length that every virtual machine supports. */
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
                throw new OutOfMemoryError("a list of " + size + " numbers"); // ends the search early
            }
            values = Arrays.copyOf(values, grown());
        }
        values[size++] = value;
    }

    private int grown() {
        return (int) Math.min(MAX_LENGTH, size + Math.max(4L, size >> 1));
    }

    /** The bytes needed while {@code more} values are added, including the copy made when the array grows. */
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
