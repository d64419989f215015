package io.troupe.broker;

import io.troupe.actor.Settings;
import java.time.Duration;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Time limits and health checks of a broker.
 *
 * {@snippet :
 * var settings = BrokerSettings.defaults()
 *         .withCheckEvery(Duration.ofMillis(500))
 *         .withMissedChecks(2)
 *         .withStartLimit(Duration.ofSeconds(20))
 *         .withObserver(observer);
 * }
 */
public final class BrokerSettings extends Settings<BrokerSettings> {
    private static final BrokerSettings DEFAULTS = new BrokerSettings();

    private @Nullable Duration checkEvery = Duration.ofSeconds(1);
    private Duration checkLimit = Duration.ofSeconds(1);
    private int missedChecks = 3;
    private Duration startLimit = Duration.ofSeconds(10);
    private Duration stopLimit = Duration.ofSeconds(5);
    private Duration notifyLimit = Duration.ofSeconds(1);
    private @Nullable Duration restartPause = Duration.ofSeconds(1);
    private Duration longestRestartPause = Duration.ofMinutes(1);
    private BrokerObserver observer = BrokerObserver.logging();

    private BrokerSettings() {}

    /**
     * A check every second with a limit of 1 s, failed after three missed checks, 10 s for a start, 5 s for a stop,
     * restarts after 1 s to 1 min; writes to the log.
     */
    public static BrokerSettings defaults() {
        return DEFAULTS;
    }

    @Override
    protected void check() {
        positive("checkEvery", checkEvery);
        positive("checkLimit", checkLimit);
        positive("startLimit", startLimit);
        positive("stopLimit", stopLimit);
        positive("notifyLimit", notifyLimit);
        positive("restartPause", restartPause);
        if (missedChecks < 1) {
            throw new IllegalArgumentException("missedChecks is " + missedChecks + ", expected 1 or more");
        }
        if (restartPause != null && longestRestartPause.compareTo(restartPause) < 0) {
            throw new IllegalArgumentException("longestRestartPause is " + longestRestartPause
                    + ", expected at least restartPause, which is " + restartPause);
        }
    }

    private static void positive(String name, @Nullable Duration value) {
        if (value != null && (value.isNegative() || value.isZero())) {
            throw new IllegalArgumentException(name + " is " + value + ", expected more than zero");
        }
    }

    /** The time from the answer to a health check, or its limit, to the next check. */
    public BrokerSettings withCheckEvery(Duration pause) {
        Objects.requireNonNull(pause, "checkEvery");
        return with(copy -> copy.checkEvery = pause);
    }

    /** Providers are not checked: one fails only when a call or its own report shows it. */
    public BrokerSettings withoutChecks() {
        return with(copy -> copy.checkEvery = null);
    }

    /** The time limit of a health check. */
    public BrokerSettings withCheckLimit(Duration limit) {
        Objects.requireNonNull(limit, "checkLimit");
        return with(copy -> copy.checkLimit = limit);
    }

    /** After so many consecutive checks without an answer, a suspect provider has failed. */
    public BrokerSettings withMissedChecks(int missed) {
        return with(copy -> copy.missedChecks = missed);
    }

    /** The time limit of a start. */
    public BrokerSettings withStartLimit(Duration limit) {
        Objects.requireNonNull(limit, "startLimit");
        return with(copy -> copy.startLimit = limit);
    }

    /** The time limit of a stop. */
    public BrokerSettings withStopLimit(Duration limit) {
        Objects.requireNonNull(limit, "stopLimit");
        return with(copy -> copy.stopLimit = limit);
    }

    /**
     * The longest time that the broker waits for clients to be notified before it stops a provider that was replaced or
     * withdrawn.
     */
    public BrokerSettings withNotifyLimit(Duration limit) {
        Objects.requireNonNull(limit, "notifyLimit");
        return with(copy -> copy.notifyLimit = limit);
    }

    /**
     * A failed provider is started again after a pause if a connection waits for it. The pause doubles with every
     * failure until the provider has run for the longest pause.
     */
    public BrokerSettings withRestartPauses(Duration first, Duration longest) {
        Objects.requireNonNull(first, "restartPause");
        Objects.requireNonNull(longest, "longestRestartPause");
        return with(copy -> {
            copy.restartPause = first;
            copy.longestRestartPause = longest;
        });
    }

    /** A failed provider is only started again by {@link Broker#require} or {@link Broker#connect}. */
    public BrokerSettings withoutRestart() {
        return with(copy -> copy.restartPause = null);
    }

    /** Is notified of all events; by default they are logged. */
    public BrokerSettings withObserver(BrokerObserver newObserver) {
        Objects.requireNonNull(newObserver, "observer");
        return with(copy -> copy.observer = newObserver);
    }

    /** See {@link #withCheckEvery}; null = no checks. */
    public @Nullable Duration checkEvery() {
        return checkEvery;
    }

    public Duration checkLimit() {
        return checkLimit;
    }

    public int missedChecks() {
        return missedChecks;
    }

    public Duration startLimit() {
        return startLimit;
    }

    public Duration stopLimit() {
        return stopLimit;
    }

    public Duration notifyLimit() {
        return notifyLimit;
    }

    /** See {@link #withRestartPauses}; null = no restart. */
    public @Nullable Duration restartPause() {
        return restartPause;
    }

    public Duration longestRestartPause() {
        return longestRestartPause;
    }

    public BrokerObserver observer() {
        return observer;
    }
}
