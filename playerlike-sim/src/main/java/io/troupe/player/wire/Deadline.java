package io.troupe.player.wire;

import io.troupe.actor.Clock;
import java.time.Duration;

/**
 * The time at which the limit of a call expires; it covers everything the call waits for.
 *
 * @param nanos reading of the clock at that time
 */
record Deadline(Clock clock, Duration limit, long nanos) {
    static Deadline after(Duration limit, Clock clock) {
        return new Deadline(clock, limit, clock.nanos() + nanos(limit));
    }

    /** The remaining time; 0 or less once the limit has expired. */
    long leftNanos() {
        return nanos - clock.nanos();
    }

    /** The limit in nanoseconds, capped at the longest that a long can hold: 292 years. */
    static long nanos(Duration limit) {
        try {
            return limit.toNanos();
        } catch (ArithmeticException tooLong) {
            return limit.isNegative() ? Long.MIN_VALUE : Long.MAX_VALUE;
        }
    }

    String millis() {
        return nanos(limit) / 1_000_000 + " ms";
    }
}
