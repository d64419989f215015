package io.troupe.petri.deadlock;

/** A set of fingerprints of markings: 16 to 32 bytes for each. */
final class FingerprintSet {
    private long[] table = new long[1 << 10];
    private int size;

    int size() {
        return size;
    }

    boolean has(long fingerprint) {
        return table[slot(key(fingerprint))] != 0;
    }

    void add(long fingerprint) {
        var key = key(fingerprint);
        var slot = slot(key);
        if (table[slot] != 0) {
            return;
        }
        table[slot] = key;
        if (++size * 2 > table.length) {
            var old = table;
            table = new long[2 * old.length];
            for (var each : old) {
                if (each != 0) {
                    table[slot(each)] = each;
                }
            }
        }
    }

    /** 0 marks a free slot. */
    private static long key(long fingerprint) {
        return fingerprint == 0 ? 1 : fingerprint;
    }

    private int slot(long key) {
        var mask = table.length - 1;
        var slot = (int) ((key * 0x9E3779B97F4A7C15L) >>> 32) & mask;
        while (table[slot] != 0 && table[slot] != key) {
            slot = slot + 1 & mask;
        }
        return slot;
    }
}
