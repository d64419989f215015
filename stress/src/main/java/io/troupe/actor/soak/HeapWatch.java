package io.troupe.actor.soak;

import java.lang.management.ManagementFactory;
import java.lang.management.MemoryMXBean;

/** The used heap after a collection, against what it was at the beginning. */
final class HeapWatch {
    private static final double MIB = 1024 * 1024;

    private final MemoryMXBean memory = ManagementFactory.getMemoryMXBean();
    private final double boundMib;
    private final double firstMib;
    private double highestMib;

    /** @param boundMib how much more than at the beginning may be in use */
    HeapWatch(double boundMib) {
        this.boundMib = boundMib;
        this.firstMib = usedMib();
        this.highestMib = firstMib;
    }

    /** Collects, and looks. */
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
