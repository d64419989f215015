package io.troupe.services.broker;

import java.time.Duration;
import java.util.Objects;

/**
 * How a broker watches what it runs; immutable.
 *
 * @param checkEvery from the answer to one question for health, or its limit, to the next question
 * @param checkLimit how long an answer to it may take
 * @param missedChecks so many answers in a row that did not come in time make a suspect provider a failed one
 * @param startLimit how long a start may take
 * @param stopLimit how long a stop may take
 * @param hearLimit how long the broker waits, before it stops a provider that was replaced or withdrawn, for its users
 *     to hear of it
 * @param restartPause after this, a provider that has failed is started again if a connection waits for it; it doubles
 *     with every failure until it has run for {@code longestRestartPause}; zero = it is only tried again when somebody
 *     calls {@link Broker#require} or {@link Broker#connect}
 * @param longestRestartPause where the doubling ends; a provider that has run for so long is restarted after
 *     {@code restartPause} again
 * @param observer hears what happens
 */
public record BrokerSettings(
        Duration checkEvery,
        Duration checkLimit,
        int missedChecks,
        Duration startLimit,
        Duration stopLimit,
        Duration hearLimit,
        Duration restartPause,
        Duration longestRestartPause,
        BrokerObserver observer) {
    /**
     * A check every second with a limit of a second, failed after three, 10 s for a start, 5 s for a stop, restarts
     * after 1 s to 1 min; logs.
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
        positive("hearLimit", hearLimit);
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
                every, limit, missed, startLimit, stopLimit, hearLimit, restartPause, longestRestartPause, observer);
    }

    public BrokerSettings withLimits(Duration start, Duration stop, Duration hear) {
        return new BrokerSettings(
                checkEvery, checkLimit, missedChecks, start, stop, hear, restartPause, longestRestartPause, observer);
    }

    public BrokerSettings withRestart(Duration pause, Duration longest) {
        return new BrokerSettings(
                checkEvery, checkLimit, missedChecks, startLimit, stopLimit, hearLimit, pause, longest, observer);
    }

    /** What has failed is only tried again when somebody requires it. */
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
                hearLimit,
                restartPause,
                longestRestartPause,
                newObserver);
    }
}
