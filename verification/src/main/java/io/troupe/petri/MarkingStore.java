package io.troupe.petri;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/**
 * A set of markings, numbered from 0 in the order of insertion, packed into words.
 *
 * <p>Every place has a field of the same number of bits, a power of two, so that no field crosses a word boundary. As
 * long as all fields are in range, a firing is one addition for each word: carries and borrows between fields cancel
 * out modulo 2^64. A safe net needs one bit for each place.
 */
final class MarkingStore {
    private static final int CHUNK_BITS = 12;
    /** The largest number of markings, whatever the memory. */
    static final int MAX_SIZE = 1 << 29;

    private final int places;
    private final int bits;
    private final int words;
    private final List<long[]> chunks = new ArrayList<>();
    /** A hash table with open addressing: an entry is the number of a marking plus one, 0 is free. */
    private int[] table = new int[1 << 10];

    private int size;

    MarkingStore(int places, int bits) {
        this.places = places;
        this.bits = bits;
        this.words = Math.max(1, Math.ceilDiv(places * bits, Long.SIZE));
    }

    /** The most tokens that a field can hold. */
    long capacity() {
        return bits == Long.SIZE ? Long.MAX_VALUE : (1L << bits) - 1;
    }

    int words() {
        return words;
    }

    int size() {
        return size;
    }

    /** A copy with the same numbers, and fields of twice the width. */
    MarkingStore widened() {
        var wider = new MarkingStore(places, bits * 2);
        var tokens = new long[places];
        for (var id = 0; id < size; id++) {
            read(id, tokens);
            wider.add(wider.pack(tokens));
        }
        return wider;
    }

    long[] pack(long[] tokens) {
        var packed = new long[words];
        pack(tokens, packed);
        return packed;
    }

    void pack(long[] tokens, long[] packed) {
        Arrays.fill(packed, 0);
        for (var place = 0; place < places; place++) {
            packed[word(place)] += tokens[place] << shift(place);
        }
    }

    /** The words to add to a marking to fire {@code transition}. */
    long[] change(Transition transition) {
        var packed = new long[words];
        for (var arc : transition.inputs()) {
            packed[word(arc.place().index())] -=
                    (long) arc.weight() << shift(arc.place().index());
        }
        for (var arc : transition.outputs()) {
            packed[word(arc.place().index())] +=
                    (long) arc.weight() << shift(arc.place().index());
        }
        return packed;
    }

    void read(int id, long[] tokens) {
        unpack(chunks.get(id >>> CHUNK_BITS), offset(id), tokens);
    }

    void unpack(long[] packed, long[] tokens) {
        unpack(packed, 0, tokens);
    }

    private void unpack(long[] packed, int start, long[] tokens) {
        var mask = capacity();
        for (var place = 0; place < places; place++) {
            tokens[place] = packed[start + word(place)] >>> shift(place) & mask;
        }
    }

    /** Writes marking {@code id} plus {@code change} to {@code result}. */
    void plus(int id, long[] change, long[] result) {
        var chunk = chunks.get(id >>> CHUNK_BITS);
        var start = offset(id);
        for (var word = 0; word < words; word++) {
            result[word] = chunk[start + word] + change[word];
        }
    }

    /** The number of a marking, or -1 if it is not stored. */
    int find(long[] packed) {
        return table[slot(packed)] - 1;
    }

    /** Adds a marking that is not stored yet, and returns its number. */
    int add(long[] packed) {
        if (size == MAX_SIZE) {
            throw new IllegalStateException("more than " + MAX_SIZE + " markings");
        }
        if (size * 2 >= table.length) {
            rehash();
        }
        if (size >>> CHUNK_BITS == chunks.size()) {
            chunks.add(new long[words << CHUNK_BITS]);
        }
        System.arraycopy(packed, 0, chunks.get(size >>> CHUNK_BITS), offset(size), words);
        table[slot(packed)] = size + 1;
        return size++;
    }

    /** The bytes needed while {@code more} markings are added, including the new hash table made when it grows. */
    long bytesWith(int more) {
        var chunksNeeded = ((long) size + more >>> CHUNK_BITS) + 1;
        var grows = ((long) size + more) * 2 >= table.length;
        return (chunksNeeded * words * Long.BYTES << CHUNK_BITS) + table.length * (grows ? 12L : 4L);
    }

    private void rehash() {
        var packed = new long[words];
        table = new int[table.length * 2];
        for (var id = 0; id < size; id++) {
            var chunk = chunks.get(id >>> CHUNK_BITS);
            System.arraycopy(chunk, offset(id), packed, 0, words);
            table[slot(packed)] = id + 1;
        }
    }

    private int slot(long[] packed) {
        var mask = table.length - 1;
        var slot = hash(packed) & mask;
        while (table[slot] != 0 && !equal(table[slot] - 1, packed)) {
            slot = (slot + 1) & mask;
        }
        return slot;
    }

    private boolean equal(int id, long[] packed) {
        var start = offset(id);
        return Arrays.equals(chunks.get(id >>> CHUNK_BITS), start, start + words, packed, 0, words);
    }

    /**
     * A product depends on the bits of its factor that are not above its own. So a bit of any field must come down, by
     * a shift, and go through one more product: else markings that differ in the last field of a word alone have equal
     * low bits, and share a slot.
     */
    static int hash(long[] packed) {
        var hash = 0L;
        for (var word : packed) {
            hash = (hash ^ word) * 0x9E3779B97F4A7C15L;
            hash ^= hash >>> 32;
        }
        return (int) (hash * 0xBF58476D1CE4E5B9L >>> 32);
    }

    private int offset(int id) {
        return (id & (1 << CHUNK_BITS) - 1) * words;
    }

    private int word(int place) {
        return place * bits >>> 6;
    }

    private int shift(int place) {
        return place * bits & 63;
    }
}
