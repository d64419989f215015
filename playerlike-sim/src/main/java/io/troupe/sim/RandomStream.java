package io.troupe.sim;

/**
 * Reproducible random numbers, with a separate stream for each (seed, robot, device).
 *
 * <p><b>Source.</b> SplitMix64 (Steele, Lea, Flood, 2014), started from an FNV-1a hash of the names.
 */
final class RandomStream {
    private static final long GOLDEN_GAMMA = 0x9E3779B97F4A7C15L;

    private long state;

    RandomStream(long seed, String robot, String device) {
        long names = fnv(fnv(0xCBF29CE484222325L, robot) * 31, device);
        state = mix(seed + GOLDEN_GAMMA) ^ names;
    }

    private static long fnv(long hash, String text) {
        long result = hash;
        for (int i = 0; i < text.length(); i++) {
            result = (result ^ text.charAt(i)) * 0x100000001B3L;
        }
        return result;
    }

    private static long mix(long bits) {
        long z = bits;
        z = (z ^ z >>> 30) * 0xBF58476D1CE4E5B9L;
        z = (z ^ z >>> 27) * 0x94D049BB133111EBL;
        return z ^ z >>> 31;
    }

    long nextLong() {
        state += GOLDEN_GAMMA;
        return mix(state);
    }

    /** Uniform in [-bound, bound). */
    double nextWithin(double bound) {
        return ((nextLong() >>> 11) * 0x1p-52 - 1) * bound;
    }
}
