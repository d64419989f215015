package io.troupe.tools;

import java.time.Duration;

/** Measures the heap in use. */
public final class UsedHeap {
    /** References are cleared by one collection, and what they kept is freed by a later one. */
    private static final int COLLECTIONS = 4;

    private UsedHeap() {}

    /** The bytes in use after several collections of garbage. */
    public static long bytes() {
        for (int i = 0; i < COLLECTIONS; i++) {
            System.gc();
        }
        return usedNow();
    }

    /** The same with a pause after each collection, in which other threads may drop what they still refer to. */
    public static long bytes(Duration pause) throws InterruptedException {
        for (int i = 0; i < COLLECTIONS; i++) {
            System.gc();
            Thread.sleep(pause);
        }
        return usedNow();
    }

    private static long usedNow() {
        var runtime = Runtime.getRuntime();
        return runtime.totalMemory() - runtime.freeMemory();
    }
}
