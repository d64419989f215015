package io.troupe.broker;

import io.troupe.actor.Settings;
import java.time.Duration;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Time limits of calls through a connection.
 *
 * {@snippet :
 * var patient = ConnectionSettings.defaults().withWaitLimit(Duration.ofSeconds(20)).withoutAnswerLimit();
 * var greeter = services.connect(Greeter.class, Need.ofService("guest", "greeter"), patient).actor();
 * }
 */
public final class ConnectionSettings extends Settings<ConnectionSettings> {
    private static final ConnectionSettings DEFAULTS = new ConnectionSettings();

    private Duration waitLimit = Duration.ofSeconds(5);
    private @Nullable Duration answerLimit = Duration.ofSeconds(5);
    private Duration oneWayLimit = Duration.ofSeconds(1);
    private int capacity = 1_000;

    private ConnectionSettings() {}

    /** Five seconds for requests, one second for one-way calls, at most 1000 queued calls. */
    public static ConnectionSettings defaults() {
        return DEFAULTS;
    }

    @Override
    protected void check() {
        positive("waitLimit", waitLimit);
        positive("oneWayLimit", oneWayLimit);
        if (answerLimit != null) {
            positive("answerLimit", answerLimit);
        }
        if (capacity < 0) {
            throw new IllegalArgumentException("capacity is " + capacity + ", expected 0 or more");
        }
    }

    private static void positive(String name, Duration value) {
        if (value.isNegative() || value.isZero()) {
            throw new IllegalArgumentException(name + " is " + value + ", expected more than zero");
        }
    }

    /** The longest time that a request is queued while there is no provider. */
    public ConnectionSettings withWaitLimit(Duration limit) {
        Objects.requireNonNull(limit, "waitLimit");
        return with(copy -> copy.waitLimit = limit);
    }

    /** The longest time that a provider may take for a request. */
    public ConnectionSettings withAnswerLimit(Duration limit) {
        Objects.requireNonNull(limit, "answerLimit");
        return with(copy -> copy.answerLimit = limit);
    }

    /**
     * A provider may take for a request as long as it runs: for services that answer when they end, for example
     * following a wall.
     */
    public ConnectionSettings withoutAnswerLimit() {
        return with(copy -> copy.answerLimit = null);
    }

    /**
     * The longest time that a one-way call is queued while there is no provider; short, because a command may be out of
     * date when a provider is found.
     */
    public ConnectionSettings withOneWayLimit(Duration limit) {
        Objects.requireNonNull(limit, "oneWayLimit");
        return with(copy -> copy.oneWayLimit = limit);
    }

    /** The number of calls that may be queued while there is no provider; one more is rejected at once. */
    public ConnectionSettings withCapacity(int calls) {
        return with(copy -> copy.capacity = calls);
    }

    public Duration waitLimit() {
        return waitLimit;
    }

    /** See {@link #withAnswerLimit}; null = no limit. */
    public @Nullable Duration answerLimit() {
        return answerLimit;
    }

    public Duration oneWayLimit() {
        return oneWayLimit;
    }

    public int capacity() {
        return capacity;
    }
}
