package io.troupe.services.behaviour;

/**
 * A monotonic time of one robot's readings. A robot's clock may be set back while services run, by a person or by a
 * time server; this time never goes back.
 *
 * <p><b>Role.</b> While the clock is not set back, the time equals the time stamp. A time stamp that is older than the
 * newest by a cycle or more counts as the next cycle, {@value #CYCLE_SECONDS} s later. One that is older by less is
 * jitter: the time stands still until the time stamps have caught up. A clock that is set forward cannot be
 * distinguished from a gap in the readings, and is treated as one.
 *
 * <p><b>Threads.</b> One thread at a time.
 */
public final class ReadingTime {
    /** The length of a service's cycle. */
    public static final double CYCLE_SECONDS = 0.1;
    /** Half a millisecond of tolerance for rounding. */
    private static final double LEAST_CYCLE_SECONDS = CYCLE_SECONDS - 0.0005;

    private double newestStampSeconds = Double.NEGATIVE_INFINITY;
    private double aheadSeconds; // how far the time is ahead of the time stamps

    /** Returns the time of a reading, given its time stamp. The same time stamp gives the same time. */
    public double at(double stampSeconds) {
        if (stampSeconds >= newestStampSeconds) {
            newestStampSeconds = stampSeconds;
        } else if (isCycle(newestStampSeconds, stampSeconds)) {
            aheadSeconds += newestStampSeconds - stampSeconds + CYCLE_SECONDS;
            newestStampSeconds = stampSeconds;
        }
        return newestStampSeconds + aheadSeconds;
    }

    /**
     * Whether two times are a cycle or more apart, in either direction: the second time is the earlier one if the clock
     * was set back.
     */
    public static boolean isCycle(double fromSeconds, double toSeconds) {
        return Math.abs(toSeconds - fromSeconds) >= LEAST_CYCLE_SECONDS;
    }
}
