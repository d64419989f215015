package io.troupe.actor.soak;

import java.lang.management.ManagementFactory;
import java.lang.management.MemoryMXBean;

/** Compares the heap in use after a garbage collection with that at the beginning. */
final class HeapWatch {
    private static final double MIB = 1024 * 1024;

    private final MemoryMXBean memory = ManagementFactory.getMemoryMXBean();
    private final double boundMib;
    private final double firstMib;
    private double highestMib;

    /**
     * Creates a watch.
     *
     * @param boundMib the allowed increase since the beginning
     */
    HeapWatch(double boundMib) {
        this.boundMib = boundMib;
        this.firstMib = usedMib();
        this.highestMib = firstMib;
    }

    /** Collects garbage and returns the increase. */
    double sampleMib() {
        double now = usedMib();
        highestMib = Math.max(highestMib, now);
        return now;
    }

    boolean isExceeded() {
        return highestMib > firstMib + boundMib;
    }

    private double usedMib() {
        memory.gc();
        return memory.getHeapMemoryUsage().getUsed() / MIB;
    }

    @Override
    public String toString() {
        return "heap after collection %.1f MiB at first, %.1f MiB at most, allowed %.1f MiB"
                .formatted(firstMib, highestMib, firstMib + boundMib);
    }
}
