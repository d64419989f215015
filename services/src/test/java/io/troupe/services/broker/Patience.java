package io.troupe.services.broker;

import java.time.Duration;

/**
 * Limits for tests on threads of their own, so long that a busy machine does not reach them: a test that hangs ends
 * with its time-out.
 */
final class Patience {
    static final Duration LONG = Duration.ofMinutes(10);
    static final BrokerSettings BROKER =
            BrokerSettings.DEFAULT.withChecks(LONG, LONG, 3).withLimits(LONG, LONG, LONG);
    static final ConnectionSettings CONNECTION =
            ConnectionSettings.DEFAULT.withWaitLimit(LONG).withAnswerLimit(LONG).withOneWayLimit(LONG);

    private Patience() {}
}
