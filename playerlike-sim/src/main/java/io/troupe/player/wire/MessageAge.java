package io.troupe.player.wire;

/**
 * The age of messages of one connection, from their time stamps: by how much longer a message was on its way than the
 * fastest one of the last one to two minutes. The clocks of both sides need not agree, and may drift.
 *
 * <p>The transit time of the fastest message is not part of the age. A pause between two messages counts as one second
 * at most, so after a cut of any length an age refers to messages from before the cut.
 *
 * <p><b>Threads.</b> One thread.
 */
final class MessageAge {
    /** 100 ppm of difference between two clocks amounts to 12 ms in two windows. */
    private static final double WINDOW_SECONDS = 60;

    private static final double LONGEST_PAUSE_SECONDS = 1;

    private double lastArrivalSeconds;
    private double windowSeconds;
    private double smallestOfWindow = Double.POSITIVE_INFINITY;
    private double smallestOfPreviousWindow = Double.POSITIVE_INFINITY;

    /** @param nowNanos the receiver's monotonic clock */
    MessageAge(long nowNanos) {
        lastArrivalSeconds = nowNanos / 1e9;
    }

    /**
     * The age in seconds of a message that arrives now; infinite without a finite time stamp. To be called for every
     * message of the connection.
     *
     * @param stampSeconds when it was sent, on a monotonic clock of the sender; 0 for none
     * @param arrivalNanos the receiver's monotonic clock
     */
    double seconds(double stampSeconds, long arrivalNanos) {
        if (!Double.isFinite(stampSeconds) || stampSeconds == 0) {
            return Double.POSITIVE_INFINITY;
        }
        double arrivalSeconds = arrivalNanos / 1e9;
        double difference = arrivalSeconds - stampSeconds;
        windowSeconds += Math.min(arrivalSeconds - lastArrivalSeconds, LONGEST_PAUSE_SECONDS);
        lastArrivalSeconds = arrivalSeconds;
        if (windowSeconds >= WINDOW_SECONDS) {
            windowSeconds = 0;
            smallestOfPreviousWindow = smallestOfWindow;
            smallestOfWindow = Double.POSITIVE_INFINITY;
        }
        smallestOfWindow = Math.min(smallestOfWindow, difference);
        return difference - Math.min(smallestOfWindow, smallestOfPreviousWindow);
    }
}
