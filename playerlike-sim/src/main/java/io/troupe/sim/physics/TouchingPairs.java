package io.troupe.sim.physics;

import java.util.Arrays;

/** Sorted pairs of touching bodies, with the number of polygon contacts of each pair. */
final class TouchingPairs {
    private long[] pairs = new long[64];
    private int[] counts = new int[64];
    private long[] before = new long[64]; // the pairs at the last call of `remember`
    private int size;
    private int sizeBefore;

    int size() {
        return size;
    }

    long pair(int i) {
        return pairs[i];
    }

    void remember() {
        if (before.length < size) {
            before = new long[pairs.length];
        }
        System.arraycopy(pairs, 0, before, 0, size);
        sizeBefore = size;
    }

    /** True if the bodies touched at the last call of {@link #remember}. */
    boolean touchedBefore(long pair) {
        return Arrays.binarySearch(before, 0, sizeBefore, pair) >= 0;
    }

    void begin(long pair) {
        int at = Arrays.binarySearch(pairs, 0, size, pair);
        if (at >= 0) {
            counts[at]++;
            return;
        }
        if (size == pairs.length) {
            pairs = Arrays.copyOf(pairs, 2 * size);
            counts = Arrays.copyOf(counts, 2 * size);
        }
        int to = -at - 1;
        System.arraycopy(pairs, to, pairs, to + 1, size - to);
        System.arraycopy(counts, to, counts, to + 1, size - to);
        pairs[to] = pair;
        counts[to] = 1;
        size++;
    }

    void end(long pair) {
        int at = Arrays.binarySearch(pairs, 0, size, pair);
        if (at >= 0 && --counts[at] == 0) {
            size--;
            System.arraycopy(pairs, at + 1, pairs, at, size - at);
            System.arraycopy(counts, at + 1, counts, at, size - at);
        }
    }
}
