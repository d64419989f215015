package io.troupe.services.component.application;

import io.troupe.services.component.ComponentObserver;
import java.time.Duration;
import java.util.function.Consumer;

/**
 * Immutable settings of an application.
 *
 * @param reconnectLimit how long a user may be without a provider after the loss of one
 * @param components listener for the events of components
 * @param events listener for the events of the application
 */
public record ApplicationSettings(
        Duration reconnectLimit, ComponentObserver components, Consumer<ApplicationEvent> events) {
    /** A reconnect limit of 3 s, which is enough for the broker to restart a provider; problems are logged. */
    public static final ApplicationSettings DEFAULT =
            new ApplicationSettings(Duration.ofSeconds(3), ComponentObserver.LOG, event -> {});

    public ApplicationSettings withReconnectLimit(Duration newReconnectLimit) {
        return new ApplicationSettings(newReconnectLimit, components, events);
    }

    public ApplicationSettings withObservers(ComponentObserver newComponents, Consumer<ApplicationEvent> newEvents) {
        return new ApplicationSettings(reconnectLimit, newComponents, newEvents);
    }
}
