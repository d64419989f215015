package io.troupe.petri;

import java.util.Arrays;

/** A growable list of ints in chunks: growing copies at most one chunk, and leaves no half of an array unused. */
final class IntList {
    private static final int CHUNK_BITS = 16;
    private static final int CHUNK = 1 << CHUNK_BITS;

    /** All chunks are full but the last; the first one may be shorter, as long as it is the only one. */
    private int[][] chunks;

    private int size;

    IntList() {
        this(64);
    }

    IntList(int capacity) {
        chunks = new int[][] {new int[Math.min(capacity, CHUNK)]};
    }

    void add(int value) {
        if (size == Integer.MAX_VALUE) {
            throw new OutOfMemoryError("a list of " + size + " numbers"); // ends the search early
        }
        var number = size >>> CHUNK_BITS;
        if (number == chunks.length) {
            var more = Arrays.copyOf(chunks, number + 1);
            more[number] = new int[CHUNK];
            chunks = more;
        }
        var chunk = chunks[number];
        var offset = size & CHUNK - 1;
        if (offset == chunk.length) {
            chunk = Arrays.copyOf(chunk, grown(offset));
            chunks[number] = chunk;
        }
        chunk[offset] = value;
        size++;
    }

    private static int grown(int length) {
        return Math.min(CHUNK, length + Math.max(4, length >> 1));
    }

    /** The bytes needed while {@code more} values are added, including the copy made when a chunk grows. */
    long bytesWith(int more) {
        var last = chunks[chunks.length - 1].length;
        var room = (long) (chunks.length - 1) * CHUNK + last;
        var needed = (long) size + more;
        if (needed <= room) {
            return Integer.BYTES * room;
        }
        var copy = last < CHUNK ? last : 0;
        return Integer.BYTES * (Math.ceilDiv(needed, CHUNK) * CHUNK + copy);
    }

    int get(int index) {
        return chunks[index >>> CHUNK_BITS][index & CHUNK - 1];
    }

    void set(int index, int value) {
        chunks[index >>> CHUNK_BITS][index & CHUNK - 1] = value;
    }

    /** Removes the last value and returns it; its memory stays reserved. */
    int removeLast() {
        var last = get(size - 1);
        size--;
        return last;
    }

    int size() {
        return size;
    }

    int[] toArray() {
        var all = new int[size];
        for (var start = 0; start < size; start += CHUNK) {
            System.arraycopy(chunks[start >>> CHUNK_BITS], 0, all, start, Math.min(CHUNK, size - start));
        }
        return all;
    }
}
