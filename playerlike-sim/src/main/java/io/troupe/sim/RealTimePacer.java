package io.troupe.sim;

import io.troupe.actor.Clock;
import java.util.Locale;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.LongConsumer;

/**
 * Keeps simulated time in step with a clock.
 *
 * <p>Deadlines are counted from one start time, so an overlong wait does no lasting harm. A late simulation catches up
 * by at most a quarter of a simulated second; the remaining delay is dropped and logged.
 *
 * <p><b>Threads.</b> The ticking thread; {@link #droppedMicros} from any thread.
 */
final class RealTimePacer {
    static final long CATCH_UP_MICROS = 250_000;
    private static final System.Logger LOG = System.getLogger(SimulationRunner.class.getName());
    /** About 73 years: upper limit of an interval at any pace, so that sums of times do not overflow. */
    private static final long LONGEST_NANOS = 1L << 61;

    private static final long LOG_INTERVAL_NANOS = 1_000_000_000;

    private final Clock wall;
    private final LongConsumer sleep; // argument: maximum time in nanoseconds
    private double factor = Double.POSITIVE_INFINITY;
    private boolean started;
    private long startNanos;
    private long startMicros;
    private long unloggedMicros;
    private long loggedAtNanos;
    private boolean loggedAny;
    private final AtomicLong droppedMicros = new AtomicLong();

    RealTimePacer(Clock wall, LongConsumer sleep) {
        this.wall = wall;
        this.sleep = sleep;
    }

    /** Restarts the deadlines after a pause. */
    void restart() {
        started = false;
    }

    /**
     * Waits until the current interval of simulated time has passed on the clock.
     *
     * @param wantedFactor simulated seconds per second; infinite = do not wait
     */
    void await(long beginMicros, long endMicros, double wantedFactor) {
        if (wantedFactor == Double.POSITIVE_INFINITY) {
            started = false;
            return;
        }
        long now = wall.nanos();
        if (!started || wantedFactor != factor) {
            started = true;
            factor = wantedFactor;
            startNanos = now;
            startMicros = beginMicros;
        }
        long deadline = startNanos + wallNanos(endMicros - startMicros);
        long lateNanos = now - deadline - wallNanos(CATCH_UP_MICROS);
        if (lateNanos > 0) {
            startNanos += lateNanos;
            drop((long) (lateNanos * factor / 1000), now);
            return;
        }
        for (long left = deadline - now; left > 0; left = deadline - wall.nanos()) {
            sleep.accept(left);
        }
    }

    private long wallNanos(long simulatedMicros) {
        return (long) Math.min(simulatedMicros * 1000 / factor, LONGEST_NANOS);
    }

    /** Counts dropped time, and logs it at most once per second. */
    private void drop(long micros, long nowNanos) {
        droppedMicros.addAndGet(micros);
        unloggedMicros += micros;
        if (!loggedAny || nowNanos - loggedAtNanos >= LOG_INTERVAL_NANOS) {
            LOG.log(
                    System.Logger.Level.WARNING,
                    String.format(
                            Locale.ROOT,
                            "the machine is too slow for %.3g times real time: %.3f simulated seconds are late for good",
                            factor,
                            unloggedMicros / 1e6));
            loggedAny = true;
            loggedAtNanos = nowNanos;
            unloggedMicros = 0;
        }
    }

    /** Simulated time that was late and has been dropped. */
    long droppedMicros() {
        return droppedMicros.get();
    }
}
