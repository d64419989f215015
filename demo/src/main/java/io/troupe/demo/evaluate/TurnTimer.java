package io.troupe.demo.evaluate;

/** Machine time of the work at each reading: from the first cycle to the last message that results from it. */
final class TurnTimer {
    private final Durations durations = new Durations();
    private long readingNanos = Long.MIN_VALUE;
    private long began;
    private long last;

    /**
     * Starts a cycle.
     *
     * @param reading robot time of its reading
     * @param now machine time
     */
    void begin(long reading, long now) {
        if (reading != readingNanos) {
            end();
            readingNanos = reading;
            began = now;
            last = now;
        }
    }

    /** Extends the current turn up to {@code now}, in machine time. */
    void extend(long now) {
        last = now;
    }

    /** The durations of all turns so far. */
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
