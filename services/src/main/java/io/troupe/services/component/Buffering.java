package io.troupe.services.component;

/**
 * How much waits in one direction of a {@link DataConversion}, and what gives way.
 *
 * @param capacity how many values, at least 1
 */
public record Buffering(int capacity, WhenFull whenFull) {
    /** What gives way. */
    public enum WhenFull {
        /**
         * Of all values the oldest: it is lost, counted, and told to the observer. For streams in which every value
         * counts.
         */
        DROP_OLDEST,
        /**
         * A value gives way to a newer one of its topic at once, full or not, and is counted. For commands and readings
         * that only count while they are new.
         */
        LATEST_OF_EACH_TOPIC
    }

    /** 64 values, the oldest gives way. */
    public static final Buffering STREAM = new Buffering(64, WhenFull.DROP_OLDEST);

    /** The newest value of each of up to 64 topics. */
    public static final Buffering LATEST = new Buffering(64, WhenFull.LATEST_OF_EACH_TOPIC);

    public Buffering {
        if (capacity < 1) {
            throw new IllegalArgumentException("the capacity of a buffer is " + capacity + ", expected 1 or more");
        }
    }
}
