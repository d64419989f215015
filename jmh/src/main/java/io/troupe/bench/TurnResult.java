package io.troupe.bench;

import com.sun.management.ThreadMXBean;
import java.lang.management.ManagementFactory;

/**
 * The cost of one operation in one turn of a contender.
 *
 * @param nanos time in nanoseconds
 * @param bytes the bytes that all threads of the contender's process allocated
 */
record TurnResult(double nanos, double bytes) {
    /** In a field, because looking it up allocates. */
    private static final ThreadMXBean THREADS = ManagementFactory.getPlatformMXBean(ThreadMXBean.class);

    /** This turn as a line of the pipe. */
    String line() {
        return nanos + " " + bytes;
    }

    static TurnResult parse(String line) {
        String[] parts = line.split(" ");
        if (parts.length != 2) {
            throw new IllegalArgumentException(
                    "a turn is \"" + line + "\", expected nanoseconds and bytes per operation");
        }
        return new TurnResult(Double.parseDouble(parts[0]), Double.parseDouble(parts[1]));
    }

    /** The heap bytes that all threads of this JVM have allocated so far. */
    static long allocatedBytes() {
        return THREADS.getTotalThreadAllocatedBytes();
    }
}
