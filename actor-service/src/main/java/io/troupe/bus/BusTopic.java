package io.troupe.bus;

import io.troupe.actor.Settings;
import io.troupe.bus.internal.Portable;
import java.time.Duration;
import java.util.Objects;
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
 * newest counts, a topic may have a capacity, and may drop values that are too old: a velocity that was held up on its
 * way is not obeyed late.
 *
 * {@snippet :
 * static final BusTopic<Velocity> DRIVE = new BusTopic<>("robot1/drive", Velocity.class)
 *         .withCapacity(1)
 *         .withMaxAge(Duration.ofMillis(300));
 * }
 */
public final class BusTopic<T extends Record> extends Settings<BusTopic<T>> {
    private final String name;
    private final Class<T> type;
    private @Nullable Integer capacity;
    private @Nullable Duration maxAge;

    /** A topic whose values are all delivered. */
    public BusTopic(String name, Class<T> type) {
        if (name.isBlank()) {
            throw new IllegalArgumentException("the name of a topic is blank");
        }
        Portable.check("topic " + name, type);
        this.name = name;
        this.type = type;
    }

    @Override
    protected void check() {
        if (capacity != null && capacity < 1) {
            throw new IllegalArgumentException(
                    "the capacity of topic " + name + " is " + capacity + ", expected 1 or more");
        }
        if (maxAge != null && (maxAge.isNegative() || maxAge.isZero())) {
            throw new IllegalArgumentException(
                    "the greatest age of values of topic " + name + " is " + maxAge + ", expected more than zero");
        }
    }

    /**
     * The same topic, for subscribers that need only the newest values: at most so many are queued for each of them,
     * and one more replaces the oldest. That is no loss, and is not reported. By default the capacity of the bus
     * applies.
     */
    public BusTopic<T> withCapacity(int values) {
        return with(copy -> copy.capacity = values);
    }

    /**
     * The same topic, without values that are older than that when a subscriber would receive them: they are dropped,
     * and reported to the bus's observer. By default values do not age.
     */
    public BusTopic<T> withMaxAge(Duration age) {
        Objects.requireNonNull(age, "age");
        return with(copy -> copy.maxAge = age);
    }

    /** A topic of another type with the same name, capacity and age. */
    public <S extends Record> BusTopic<S> ofType(Class<S> other) {
        return new BusTopic<>(name, other).with(copy -> {
            copy.capacity = capacity;
            copy.maxAge = maxAge;
        });
    }

    public String name() {
        return name;
    }

    public Class<T> type() {
        return type;
    }

    /** See {@link #withCapacity}; null = that of the bus. */
    public @Nullable Integer capacity() {
        return capacity;
    }

    /** See {@link #withMaxAge}; null = no limit. */
    public @Nullable Duration maxAge() {
        return maxAge;
    }

    /** Topics are equal if everything that is set is equal. */
    @Override
    public boolean equals(@Nullable Object other) {
        return other instanceof BusTopic<?> that
                && name.equals(that.name)
                && type == that.type
                && Objects.equals(capacity, that.capacity)
                && Objects.equals(maxAge, that.maxAge);
    }

    @Override
    public int hashCode() {
        return Objects.hash(name, type, capacity, maxAge);
    }

    @Override
    public String toString() {
        return "topic " + name + " of " + type.getName();
    }
}
