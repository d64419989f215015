package io.troupe.broker;

import io.troupe.bus.internal.BoundedText;
import java.lang.System.Logger.Level;
import org.jspecify.annotations.Nullable;

/**
 * Observes all events of a broker.
 *
 * {@snippet :
 * BrokerObserver observer = events::add;
 *
 * Broker broker = Broker.open(space, BrokerSettings.defaults().withObserver(observer));
 * }
 *
 * <p><b>Threads.</b> Called on the broker's space; for events about calls through an actor connection, on the
 * connection's space. Exceptions are reported to that space's error handler and have no other effect.
 */
@FunctionalInterface
public interface BrokerObserver {
    void on(BrokerEvent event);

    /** Writes to the system log: failures as warnings, other events at debug level. */
    static BrokerObserver logging() {
        var log = System.getLogger(BrokerObserver.class.getName());
        return event -> log.log(level(event), BoundedText.of(event), error(event));
    }

    private static Level level(BrokerEvent event) {
        return switch (event) {
            case BrokerEvent.StartFailed e -> Level.WARNING;
            case BrokerEvent.Suspect e -> Level.WARNING;
            case BrokerEvent.Failed e -> Level.WARNING;
            case BrokerEvent.FailedOver e -> Level.WARNING;
            case BrokerEvent.Lost e -> Level.WARNING;
            case BrokerEvent.StopFailed e -> Level.WARNING;
            case BrokerEvent.Late e -> Level.WARNING;
            case BrokerEvent.UserFailed e -> Level.WARNING;
            case BrokerEvent.CallRejected e -> Level.WARNING;
            case BrokerEvent.LeftRunning e -> Level.WARNING;
            default -> Level.DEBUG;
        };
    }

    private static @Nullable Throwable error(BrokerEvent event) {
        return switch (event) {
            case BrokerEvent.StartFailed e -> e.why();
            case BrokerEvent.Suspect e -> e.why();
            case BrokerEvent.Failed e -> e.why();
            case BrokerEvent.Lost e -> e.why();
            case BrokerEvent.StopFailed e -> e.why();
            case BrokerEvent.Late e -> e.error();
            case BrokerEvent.UserFailed e -> e.why();
            case BrokerEvent.CallRejected e -> e.why();
            default -> null;
        };
    }
}
