package io.troupe.services.component;

/**
 * The capacity of one buffer of a {@link DataConversion}. A full buffer drops the oldest value of all topics; that is
 * counted and reported to the observer.
 *
 * @param capacity the number of values that may be buffered, 1 or more
 * @param onlyLatest true if a new value replaces the buffered value of its topic, even if there is room for both, for
 *     commands and readings that are useful only while they are new. Replaced values are counted, and not reported
 */
public record Buffering(int capacity, boolean onlyLatest) {
    /** 64 values; for streams in which every value counts. */
    public static final Buffering STREAM = new Buffering(64, false);

    /** The latest value of each of up to 64 topics. */
    public static final Buffering LATEST = new Buffering(64, true);

    public Buffering {
        if (capacity < 1) {
            throw new IllegalArgumentException("the capacity of a buffer is " + capacity + ", expected 1 or more");
        }
    }
}
