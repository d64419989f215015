package io.troupe.demo.evaluate;

/**
 * How long there is something to do each time a reading comes: from its first cycle to the last of what follows from
 * it.
 */
final class Turns {
    private final Durations durations = new Durations();
    private long readingNanos = Long.MIN_VALUE;
    private long began;
    private long last;

    /**
     * A cycle begins.
     *
     * @param reading when its reading was taken, on the robots' clock
     * @param now on the machine's clock
     */
    void begin(long reading, long now) {
        if (reading != readingNanos) {
            end();
            readingNanos = reading;
            began = now;
            last = now;
        }
    }

    /** Something has been done, by now on the machine's clock. */
    void goesOn(long now) {
        last = now;
    }

    /** All of them up to now. */
    Durations durations() {
        end();
        return durations;
    }

    private void end() {
        if (readingNanos != Long.MIN_VALUE) {
            durations.add(last - began);
            readingNanos = Long.MIN_VALUE;
        }
    }
}
