package io.troupe.player.wire;

import io.troupe.actor.time.Clock;
import java.time.Duration;

/**
 * The moment at which a call's limit is over: one for all that the call waits for.
 *
 * @param nanos by the clock
 */
record Deadline(Clock clock, Duration limit, long nanos) {
    static Deadline after(Duration limit, Clock clock) {
        return new Deadline(clock, limit, clock.nanos() + nanos(limit));
    }

    /** 0 or less when the limit is over. */
    long leftNanos() {
        return nanos - clock.nanos();
    }

    /** At most what differences of nanoseconds can tell: 292 years. */
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
