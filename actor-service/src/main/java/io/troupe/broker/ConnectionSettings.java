package io.troupe.broker;

import java.time.Duration;

/**
 * Time limits of calls through a connection; immutable.
 *
 * {@snippet :
 * var patient = ConnectionSettings.DEFAULT.withWaitLimit(Duration.ofSeconds(20)).withoutAnswerLimit();
 * var greeter = services.connect(Greeter.class, Need.ofService("guest", "greeter"), patient).actor();
 * }
 *
 * @param waitLimit the longest time that a request is queued while there is no provider
 * @param answerLimit the longest time that a provider may take for a request; zero = as long as the provider runs
 * @param oneWayLimit the longest time that a one-way call is queued while there is no provider; short, because a
 *     command may be out of date when a provider is found
 * @param mostWaiting the most calls queued while there is no provider; further calls are rejected at once
 */
public record ConnectionSettings(Duration waitLimit, Duration answerLimit, Duration oneWayLimit, int mostWaiting) {
    /** Five seconds for requests, one second for one-way calls, at most 1000 queued calls. */
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

    /** For services that answer when they end, for example following a wall. */
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
