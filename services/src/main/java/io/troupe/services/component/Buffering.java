package io.troupe.services.component;

/**
 * Capacity and overflow policy of one buffer of a {@link DataConversion}.
 *
 * @param capacity maximum number of buffered values, at least 1
 */
public record Buffering(int capacity, OverflowPolicy overflow) {
    /** Which value is discarded. */
    public enum OverflowPolicy {
        /**
         * A full buffer drops the oldest value of all topics. The value is counted and reported to the observer. For
         * streams in which every value counts.
         */
        DROP_OLDEST,
        /**
         * A new value replaces the buffered value of its topic, even if there is room for both. Replaced values are
         * counted, but not reported. If more topics than the capacity have values, the oldest value is dropped. For
         * commands and readings that are useful only while they are new.
         */
        LATEST_OF_EACH_TOPIC
    }

    /** 64 values; a full buffer drops the oldest. */
    public static final Buffering STREAM = new Buffering(64, OverflowPolicy.DROP_OLDEST);

    /** The latest value of each of up to 64 topics. */
    public static final Buffering LATEST = new Buffering(64, OverflowPolicy.LATEST_OF_EACH_TOPIC);

    public Buffering {
        if (capacity < 1) {
            throw new IllegalArgumentException("the capacity of a buffer is " + capacity + ", expected 1 or more");
        }
    }
}
