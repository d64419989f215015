package io.troupe.services.behaviour;

/**
 * The time of one robot's readings, made so that it only goes on: what a robot's clock says may be set while services
 * run, by a person or by a time server.
 *
 * <p><b>Role.</b> A time stamp that is older than the newest by a cycle or more counts as the next cycle,
 * {@value #CYCLE_SECONDS} s later; by less, as time stamps that jitter are, it counts as the same time, which goes on
 * when the time stamps have made up for it. As long as no clock is set back it is the time stamp itself. A clock that
 * is set forward cannot be told from a gap in the readings, and counts as one.
 *
 * <p><b>Threads.</b> One thread at a time.
 */
public final class ReadingTime {
    /** How long a service's cycle takes. */
    public static final double CYCLE_SECONDS = 0.1;
    /** Half a millisecond forgives rounding. */
    private static final double LEAST_CYCLE_SECONDS = CYCLE_SECONDS - 0.0005;

    private double newestStampSeconds = Double.NEGATIVE_INFINITY;
    private double aheadSeconds; // of the stamps

    /** The time of the newest reading, by its time stamp; the same stamp again is the same time. */
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
     * Whether a cycle is over between two times; also if the second lies before the first, by a clock that was set
     * back.
     */
    public static boolean isCycle(double fromSeconds, double toSeconds) {
        return Math.abs(toSeconds - fromSeconds) >= LEAST_CYCLE_SECONDS;
    }
}
