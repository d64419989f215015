package io.troupe.bench.bus;

import com.sun.management.OperatingSystemMXBean;
import com.sun.management.ThreadMXBean;
import io.troupe.tools.SampleStatistics;
import java.lang.management.ManagementFactory;
import java.util.Arrays;
import java.util.List;
import java.util.function.BooleanSupplier;
import java.util.function.LongSupplier;
import java.util.stream.Collectors;
import java.util.stream.DoubleStream;
import java.util.stream.Stream;

/**
 * The result of one turn of a contender.
 *
 * @param micros the time of an operation; at each of {@link #SHARES} if operations are timed one by one, otherwise the
 *     mean alone
 * @param processorMicros the processor time of all threads of its JVM, per operation
 * @param bytes the bytes that all threads of its JVM allocated, per operation
 */
record BusTurn(List<Double> micros, double processorMicros, double bytes) {
    /** The shares of operations whose times are reported. */
    static final List<Double> SHARES = List.of(0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99, 0.999);

    /** In fields, because looking them up allocates. */
    private static final ThreadMXBean THREADS = ManagementFactory.getPlatformMXBean(ThreadMXBean.class);

    private static final OperatingSystemMXBean SYSTEM =
            ManagementFactory.getPlatformMXBean(OperatingSystemMXBean.class);
    private static final int MOST_TIMED = 100_000;

    /** Operations that are timed together. */
    @FunctionalInterface
    interface Operations {
        void run() throws Exception;
    }

    /** Repeats an operation as long as the supplier returns true, which is called after each. */
    @FunctionalInterface
    interface Repetition {
        void run(BooleanSupplier again) throws Exception;
    }

    /** Repeats an operation for about {@code budgetNanos}, and times each. */
    static BusTurn ofEach(Repetition operations, long budgetNanos) throws Exception {
        var times = new Times(budgetNanos);
        long bytes = THREADS.getTotalThreadAllocatedBytes();
        long processor = SYSTEM.getProcessCpuTime();
        times.begin();
        operations.run(times);
        processor = SYSTEM.getProcessCpuTime() - processor;
        bytes = THREADS.getTotalThreadAllocatedBytes() - bytes;
        double[] sorted = Arrays.copyOf(times.micros, times.count);
        Arrays.sort(sorted);
        List<Double> quantiles = SHARES.stream()
                .map(share -> SampleStatistics.quantile(sorted, share))
                .toList();
        return new BusTurn(quantiles, processor / 1e3 / times.count, (double) bytes / times.count);
    }

    /** Measures the time from one operation's end to the next one's. */
    private static final class Times implements BooleanSupplier {
        private final double[] micros = new double[MOST_TIMED];
        private final long budgetNanos;
        private int count;
        private long startNanos;
        private long beforeNanos;

        Times(long budgetNanos) {
            this.budgetNanos = budgetNanos;
        }

        void begin() {
            startNanos = System.nanoTime();
            beforeNanos = startNanos;
        }

        @Override
        public boolean getAsBoolean() {
            long now = System.nanoTime();
            micros[count++] = (now - beforeNanos) / 1e3;
            beforeNanos = now;
            return count < MOST_TIMED && now - startNanos < budgetNanos;
        }
    }

    /**
     * Repeats a batch of operations for about {@code budgetNanos}.
     *
     * @param size the number of operations in the batch
     * @param nanos the clock that times them
     */
    static BusTurn ofBatches(Operations batch, int size, long budgetNanos, LongSupplier nanos) throws Exception {
        long bytes = THREADS.getTotalThreadAllocatedBytes();
        long processor = SYSTEM.getProcessCpuTime();
        long start = nanos.getAsLong();
        long count = 0;
        long spent;
        do {
            batch.run();
            count += size;
            spent = nanos.getAsLong() - start;
        } while (spent < budgetNanos);
        processor = SYSTEM.getProcessCpuTime() - processor;
        bytes = THREADS.getTotalThreadAllocatedBytes() - bytes;
        return new BusTurn(List.of(spent / 1e3 / count), processor / 1e3 / count, (double) bytes / count);
    }

    /** The processor time of the calling thread, which other load on the machine changes little. */
    static long ofThisThread() {
        return THREADS.getCurrentThreadCpuTime();
    }

    /** The mean time of an operation, or the time that this share of them did not exceed. */
    double micros(double share) {
        return micros.size() == 1 ? micros.getFirst() : micros.get(SHARES.indexOf(share));
    }

    /** This turn as a line of the pipe. */
    String line() {
        return Stream.concat(Stream.of(processorMicros, bytes), micros.stream())
                .map(String::valueOf)
                .collect(Collectors.joining(" "));
    }

    static BusTurn parse(String line) {
        double[] numbers =
                Stream.of(line.split(" ")).mapToDouble(Double::parseDouble).toArray();
        if (numbers.length != 3 && numbers.length != 2 + SHARES.size()) {
            throw new IllegalArgumentException(
                    "a turn is \"" + line + "\", expected 3 or " + (2 + SHARES.size()) + " numbers");
        }
        return new BusTurn(DoubleStream.of(numbers).skip(2).boxed().toList(), numbers[0], numbers[1]);
    }
}
