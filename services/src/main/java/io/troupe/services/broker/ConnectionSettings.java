package io.troupe.services.broker;

import java.time.Duration;

/**
 * How long calls through a connection wait; immutable.
 *
 * @param waitLimit how long a request waits while there is no provider
 * @param answerLimit how long a provider may take for a request; zero = as long as its provider lives
 * @param oneWayLimit how long a one-way call waits while there is no provider; short, since what it says may be out of
 *     date when there is one
 * @param mostWaiting so many calls may wait while there is no provider; more are refused at once
 */
public record ConnectionSettings(Duration waitLimit, Duration answerLimit, Duration oneWayLimit, int mostWaiting) {
    /** Five seconds for requests, one second for one-way calls, a thousand calls. */
    public static final ConnectionSettings DEFAULT =
            new ConnectionSettings(Duration.ofSeconds(5), Duration.ofSeconds(5), Duration.ofSeconds(1), 1000);

    public ConnectionSettings {
        if (waitLimit.isNegative() || waitLimit.isZero()) {
            throw new IllegalArgumentException("waitLimit is " + waitLimit + ", expected more than zero");
        }
        if (answerLimit.isNegative()) {
            throw new IllegalArgumentException("answerLimit is " + answerLimit + ", expected zero (none) or more");
        }
        if (oneWayLimit.isNegative() || oneWayLimit.isZero()) {
            throw new IllegalArgumentException("oneWayLimit is " + oneWayLimit + ", expected more than zero");
        }
        if (mostWaiting < 0) {
            throw new IllegalArgumentException("mostWaiting is " + mostWaiting + ", expected 0 or more");
        }
    }

    public ConnectionSettings withWaitLimit(Duration limit) {
        return new ConnectionSettings(limit, answerLimit, oneWayLimit, mostWaiting);
    }

    /** For services that answer when they end, such as driving along a wall. */
    public ConnectionSettings withoutAnswerLimit() {
        return withAnswerLimit(Duration.ZERO);
    }

    public ConnectionSettings withAnswerLimit(Duration limit) {
        return new ConnectionSettings(waitLimit, limit, oneWayLimit, mostWaiting);
    }

    public ConnectionSettings withOneWayLimit(Duration limit) {
        return new ConnectionSettings(waitLimit, answerLimit, limit, mostWaiting);
    }

    public ConnectionSettings withMostWaiting(int most) {
        return new ConnectionSettings(waitLimit, answerLimit, oneWayLimit, most);
    }
}
