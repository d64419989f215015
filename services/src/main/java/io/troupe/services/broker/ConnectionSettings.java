package io.troupe.services.broker;

import java.time.Duration;

/**
 * How long calls through a connection wait; immutable.
 *
 * @param waitLimit how long a call waits while there is no provider
 * @param answerLimit how long a provider may take for a request; zero = as long as its provider lives
 * @param mostWaiting so many calls may wait while there is no provider; more are refused at once
 */
public record ConnectionSettings(Duration waitLimit, Duration answerLimit, int mostWaiting) {
    /** Five seconds for both, a thousand calls. */
    public static final ConnectionSettings DEFAULT =
            new ConnectionSettings(Duration.ofSeconds(5), Duration.ofSeconds(5), 1000);

    public ConnectionSettings {
        if (waitLimit.isNegative() || waitLimit.isZero()) {
            throw new IllegalArgumentException("waitLimit is " + waitLimit + ", expected more than zero");
        }
        if (answerLimit.isNegative()) {
            throw new IllegalArgumentException("answerLimit is " + answerLimit + ", expected zero (none) or more");
        }
        if (mostWaiting < 0) {
            throw new IllegalArgumentException("mostWaiting is " + mostWaiting + ", expected 0 or more");
        }
    }

    public ConnectionSettings withWaitLimit(Duration limit) {
        return new ConnectionSettings(limit, answerLimit, mostWaiting);
    }

    /** For services that answer when they end, such as driving along a wall. */
    public ConnectionSettings withoutAnswerLimit() {
        return withAnswerLimit(Duration.ZERO);
    }

    public ConnectionSettings withAnswerLimit(Duration limit) {
        return new ConnectionSettings(waitLimit, limit, mostWaiting);
    }

    public ConnectionSettings withMostWaiting(int most) {
        return new ConnectionSettings(waitLimit, answerLimit, most);
    }
}
