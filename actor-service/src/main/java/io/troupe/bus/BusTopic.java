package io.troupe.bus;

import io.troupe.bus.internal.Portable;
import java.time.Duration;
import org.jspecify.annotations.Nullable;

/**
 * A name under which values of one type are published.
 *
 * {@snippet :
 * record Temperature(double celsius) {}
 *
 * static final BusTopic<Temperature> OUTSIDE = new BusTopic<>("house/outside", Temperature.class);
 * }
 *
 * <p><b>Units and shapes.</b> The type is a record of values that can leave a process; the constructor rejects any
 * other type and names the component that is at fault. Components of a value may be null, elements of a list or a map
 * may not, and a value has at most 500 levels of records, lists and maps; a value that breaks this is rejected when it
 * is published. Two topics with the same name and different types are an error as long as a port that has used the
 * first is open.
 *
 * <p><b>Age.</b> By default every value is delivered, whatever its age. For commands and readings of which only the
 * newest counts, a topic may keep only the latest value for each subscriber, and may drop values that are too old: a
 * velocity that was held up on its way is not obeyed late.
 *
 * {@snippet :
 * static final BusTopic<Velocity> DRIVE = new BusTopic<>("robot1/drive", Velocity.class)
 *         .keepingOnlyLatest()
 *         .droppingOlderThan(Duration.ofMillis(300));
 * }
 *
 * @param onlyLatest true if a value that a subscriber has not received yet is replaced by a newer one
 * @param maxAge a value that is older when its subscriber would receive it is dropped, and reported to the bus's
 *     observer; null if values do not age
 */
public record BusTopic<T extends Record>(
        String name,
        Class<T> type,
        boolean onlyLatest,
        @Nullable Duration maxAge) {
    public BusTopic {
        if (name.isBlank()) {
            throw new IllegalArgumentException("the name of a topic is blank");
        }
        Portable.check("topic " + name, type);
        if (maxAge != null && (maxAge.isNegative() || maxAge.isZero())) {
            throw new IllegalArgumentException(
                    "the greatest age of values of topic " + name + " is " + maxAge + ", expected more than zero");
        }
    }

    /** A topic whose values are all delivered. */
    public BusTopic(String name, Class<T> type) {
        this(name, type, false, null);
    }

    /** The same topic, for subscribers that need only the newest value. */
    public BusTopic<T> keepingOnlyLatest() {
        return new BusTopic<>(name, type, true, maxAge);
    }

    /** The same topic, without values that arrive later than that after they were published. */
    public BusTopic<T> droppingOlderThan(Duration age) {
        return new BusTopic<>(name, type, onlyLatest, age);
    }
}
