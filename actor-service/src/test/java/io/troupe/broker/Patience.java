package io.troupe.broker;

import java.time.Duration;

/**
 * Time limits for tests on several threads, long enough that a busy machine does not reach them. A test that hangs is
 * ended by its JUnit timeout.
 */
final class Patience {
    static final Duration LONG = Duration.ofMinutes(10);
    static final BrokerSettings BROKER =
            BrokerSettings.DEFAULT.withChecks(LONG, LONG, 3).withLimits(LONG, LONG, LONG);
    static final ConnectionSettings CONNECTION =
            ConnectionSettings.DEFAULT.withWaitLimit(LONG).withAnswerLimit(LONG).withOneWayLimit(LONG);

    private Patience() {}
}
