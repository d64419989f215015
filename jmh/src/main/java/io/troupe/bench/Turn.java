package io.troupe.bench;

import com.sun.management.ThreadMXBean;
import java.lang.management.ManagementFactory;

/**
 * What one operation took in one turn.
 *
 * @param nanos time in nanoseconds
 * @param bytes what all threads of the contender's process allocated
 */
record Turn(double nanos, double bytes) {
    /** Kept, since looking it up allocates. */
    private static final ThreadMXBean THREADS = ManagementFactory.getPlatformMXBean(ThreadMXBean.class);

    /** As a line of the pipe. */
    String line() {
        return nanos + " " + bytes;
    }

    static Turn parse(String line) {
        String[] parts = line.split(" ");
        if (parts.length != 2) {
            throw new IllegalArgumentException(
                    "a turn is \"" + line + "\", expected nanoseconds and bytes per operation");
        }
        return new Turn(Double.parseDouble(parts[0]), Double.parseDouble(parts[1]));
    }

    /** Heap bytes that all threads of this JVM have ever asked for. */
    static long allocatedBytes() {
        return THREADS.getTotalThreadAllocatedBytes();
    }
}
