package io.troupe.bench;

import com.sun.management.ThreadMXBean;
import io.troupe.bench.BuildTable.Turn;
import java.lang.management.ManagementFactory;

/** Measures the turns of a {@link BuildTable}. */
public final class TurnMeter {
    /** In a field, because looking it up allocates. */
    private static final ThreadMXBean THREADS = ManagementFactory.getPlatformMXBean(ThreadMXBean.class);

    private TurnMeter() {}

    /** What a turn does. */
    @FunctionalInterface
    public interface Work<E extends Exception> {
        void run() throws E;
    }

    /** Runs so many operations, and measures them all together. */
    public static <E extends Exception> Turn measure(long operations, Work<E> work) throws E {
        long processor = processorNanos();
        long bytes = THREADS.getTotalThreadAllocatedBytes();
        long wall = System.nanoTime();
        work.run();
        wall = System.nanoTime() - wall;
        bytes = THREADS.getTotalThreadAllocatedBytes() - bytes;
        return new Turn(wall, Math.max(0, processorNanos() - processor), bytes, operations, "");
    }

    /**
     * The processor time of all living threads of Java, in nanoseconds. Compiler and collector are not among them, and
     * the clock of the whole process would be in steps of 10 ms.
     */
    private static long processorNanos() {
        long sum = 0;
        for (long nanos : THREADS.getThreadCpuTime(THREADS.getAllThreadIds())) {
            sum += Math.max(0, nanos); // -1 if the thread has ended
        }
        return sum;
    }
}
