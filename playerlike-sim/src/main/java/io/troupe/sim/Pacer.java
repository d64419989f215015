package io.troupe.sim;

import io.troupe.actor.time.Clock;
import java.util.Locale;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.LongConsumer;

/**
 * Keeps simulated time in step with a clock.
 *
 * <p>Deadlines are counted from one moment, so that waiting a little too long once does no harm. Who is late catches
 * up, at most a quarter of a simulated second; the rest is dropped, and the log says so.
 *
 * <p><b>Threads.</b> The one that ticks; {@link #droppedMicros} from any.
 */
final class Pacer {
    static final long CATCH_UP_MICROS = 250_000;
    private static final System.Logger LOG = System.getLogger(Pacer.class.getName());
    /** Some 73 years: how long an interval takes at most, whatever the pace, so that sums of times do not overflow. */
    private static final long LONGEST_NANOS = 1L << 61;

    private static final long QUIET_NANOS = 1_000_000_000;

    private final Clock wall;
    private final LongConsumer sleep; // at most so many nanoseconds
    private double factor = Double.POSITIVE_INFINITY;
    private boolean started;
    private long startNanos;
    private long startMicros;
    private long unsaidMicros;
    private long saidAtNanos;
    private boolean saidAny;
    private final AtomicLong droppedMicros = new AtomicLong();

    Pacer(Clock wall, LongConsumer sleep) {
        this.wall = wall;
        this.sleep = sleep;
    }

    /** Forgets what has been, after a pause. */
    void restart() {
        started = false;
    }

    /**
     * Waits until an interval of simulated time is over that has just begun.
     *
     * @param wantedFactor simulated seconds in a second; infinite: do not wait
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

    /** Says so at most once in a second. */
    private void drop(long micros, long nowNanos) {
        droppedMicros.addAndGet(micros);
        unsaidMicros += micros;
        if (!saidAny || nowNanos - saidAtNanos >= QUIET_NANOS) {
            LOG.log(
                    System.Logger.Level.WARNING,
                    String.format(
                            Locale.ROOT,
                            "the machine is too slow for %.3g times real time: %.3f simulated seconds are late for good",
                            factor,
                            unsaidMicros / 1e6));
            saidAny = true;
            saidAtNanos = nowNanos;
            unsaidMicros = 0;
        }
    }

    /** How much simulated time is late for good. */
    long droppedMicros() {
        return droppedMicros.get();
    }
}
