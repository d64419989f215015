package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.tools.SampleStatistics;
import java.util.ArrayDeque;
import java.util.Arrays;
import java.util.HashMap;
import java.util.Map;
import java.util.Queue;

/**
 * Measures a run, and decides when it has enough data.
 *
 * <p><b>Threads.</b> Callbacks arrive on the thread that runs the services. {@link #result} may be called once that
 * thread has ended or waits for the world.
 */
interface Meter extends ServiceObserver, Arbitrator.StateListener {
    /** May be called by any thread. */
    boolean isDone();

    Job.Result result();

    /** The robots' clock, in nanoseconds. */
    interface RobotClock {
        long nanos();

        /**
         * End of a cycle whose computation has just finished. In lock step no time passes while services compute, so
         * this is the end of the interval in which the command takes effect. Otherwise it is the current time.
         */
        long endOfCycleNanos();
    }

    /** A growing list of durations in nanoseconds. */
    final class Durations {
        private long[] nanos = new long[64];
        private int count;

        void add(long duration) {
            if (count == nanos.length) {
                nanos = Arrays.copyOf(nanos, 2 * count);
            }
            nanos[count++] = duration;
        }

        int count() {
            return count;
        }

        /** A quantile, in units of {@code unitNanos} nanoseconds. The list must not be empty. */
        double quantile(double share, double unitNanos) {
            double[] sorted =
                    Arrays.stream(nanos, 0, count).sorted().asDoubleStream().toArray();
            return SampleStatistics.quantile(sorted, share) / unitNanos;
        }

        /**
         * The mean without the longest hundredth, which garbage collection, compilation or other programs cause; in
         * units of {@code unitNanos} nanoseconds. The list must not be empty.
         */
        double trimmedMean(double unitNanos) {
            int kept = count - count / 100;
            return Arrays.stream(nanos, 0, count).sorted().limit(kept).sum() / unitNanos / kept;
        }
    }

    /** Counts the colour messages from services to the main code, and measures their delay. */
    final class MessageMeter {
        private static final double NANOS_PER_MICRO = 1e3;

        /**
         * Send times of messages in transit, by robot. Messages of one robot arrive in the order in which they were
         * sent.
         */
        private final Map<Integer, Queue<Long>> onTheirWay = new HashMap<>();

        private final Durations delays = new Durations();
        private int sent;
        private int received;

        void sent(int robot) {
            sent++;
            onTheirWay.computeIfAbsent(robot, index -> new ArrayDeque<>()).add(System.nanoTime());
        }

        void received(int robot) {
            long now = System.nanoTime();
            Long then = onTheirWay
                    .computeIfAbsent(robot, index -> new ArrayDeque<>())
                    .poll();
            if (then != null) { // null if it was sent after counting had ended
                received++;
                delays.add(now - then);
            }
        }

        void addTo(Job.Result.Builder result) {
            result.add(Measurement.BOTH, Quantity.SENT, sent).add(Measurement.BOTH, Quantity.RECEIVED, received);
            if (delays.count() > 0) {
                result.add(Measurement.BOTH, Quantity.DELAY, delays.quantile(0.5, NANOS_PER_MICRO))
                        .add(Measurement.BOTH, Quantity.DELAY_P99, delays.quantile(0.99, NANOS_PER_MICRO));
            }
        }
    }
}
