package io.troupe.broker;

import java.time.Duration;
import java.util.Objects;

/**
 * Time limits and health checks of a broker; immutable.
 *
 * {@snippet :
 * var settings = BrokerSettings.DEFAULT
 *         .withChecks(Duration.ofMillis(500), Duration.ofMillis(200), 2)
 *         .withLimits(Duration.ofSeconds(20), Duration.ofSeconds(5), Duration.ofSeconds(1))
 *         .withObserver(observer);
 * }
 *
 * @param checkEvery the time from the answer to a health check, or its limit, to the next check
 * @param checkLimit the time limit of a health check
 * @param missedChecks after this many consecutive checks without an answer, a suspect provider has failed
 * @param startLimit the time limit of a start
 * @param stopLimit the time limit of a stop
 * @param notifyLimit the longest time that the broker waits for clients to be notified before it stops a provider that
 *     was replaced or withdrawn
 * @param restartPause a failed provider is started again after this pause if a connection waits for it; the pause
 *     doubles with every failure until the provider has run for {@code longestRestartPause}; zero = it is only started
 *     again by {@link Broker#require} or {@link Broker#connect}
 * @param longestRestartPause the upper bound of the pause; a provider that has run for this long is restarted after
 *     {@code restartPause} again
 * @param observer is notified of all events
 */
public record BrokerSettings(
        Duration checkEvery,
        Duration checkLimit,
        int missedChecks,
        Duration startLimit,
        Duration stopLimit,
        Duration notifyLimit,
        Duration restartPause,
        Duration longestRestartPause,
        BrokerObserver observer) {
    /**
     * A check every second with a limit of 1 s, failed after three missed checks, 10 s for a start, 5 s for a stop,
     * restarts after 1 s to 1 min; writes to the log.
     */
    public static final BrokerSettings DEFAULT = new BrokerSettings(
            Duration.ofSeconds(1),
            Duration.ofSeconds(1),
            3,
            Duration.ofSeconds(10),
            Duration.ofSeconds(5),
            Duration.ofSeconds(1),
            Duration.ofSeconds(1),
            Duration.ofMinutes(1),
            BrokerObserver.logging());

    public BrokerSettings {
        positive("checkEvery", checkEvery);
        positive("checkLimit", checkLimit);
        positive("startLimit", startLimit);
        positive("stopLimit", stopLimit);
        positive("notifyLimit", notifyLimit);
        if (missedChecks < 1) {
            throw new IllegalArgumentException("missedChecks is " + missedChecks + ", expected 1 or more");
        }
        if (restartPause.isNegative()) {
            throw new IllegalArgumentException("restartPause is " + restartPause + ", expected zero (off) or more");
        }
        if (longestRestartPause.compareTo(restartPause) < 0) {
            throw new IllegalArgumentException("longestRestartPause is " + longestRestartPause
                    + ", expected at least restartPause, which is " + restartPause);
        }
        Objects.requireNonNull(observer, "observer");
    }

    private static void positive(String name, Duration value) {
        if (value.isNegative() || value.isZero()) {
            throw new IllegalArgumentException(name + " is " + value + ", expected more than zero");
        }
    }

    public BrokerSettings withChecks(Duration every, Duration limit, int missed) {
        return new BrokerSettings(
                every, limit, missed, startLimit, stopLimit, notifyLimit, restartPause, longestRestartPause, observer);
    }

    public BrokerSettings withLimits(Duration start, Duration stop, Duration notify) {
        return new BrokerSettings(
                checkEvery, checkLimit, missedChecks, start, stop, notify, restartPause, longestRestartPause, observer);
    }

    public BrokerSettings withRestart(Duration pause, Duration longest) {
        return new BrokerSettings(
                checkEvery, checkLimit, missedChecks, startLimit, stopLimit, notifyLimit, pause, longest, observer);
    }

    /** A failed provider is only started again when it is required. */
    public BrokerSettings withoutRestart() {
        return withRestart(Duration.ZERO, Duration.ZERO);
    }

    public BrokerSettings withObserver(BrokerObserver newObserver) {
        return new BrokerSettings(
                checkEvery,
                checkLimit,
                missedChecks,
                startLimit,
                stopLimit,
                notifyLimit,
                restartPause,
                longestRestartPause,
                newObserver);
    }
}
