package io.troupe.services.component.application;

import io.troupe.actor.Settings;
import io.troupe.broker.BrokerSettings;
import io.troupe.services.component.ComponentObserver;
import java.time.Duration;
import java.util.Objects;
import java.util.function.Consumer;

/** Settings of an application. */
public final class ApplicationSettings extends Settings<ApplicationSettings> {
    private static final ApplicationSettings DEFAULTS = new ApplicationSettings();

    private Duration reconnectLimit = Duration.ofSeconds(3);
    private BrokerSettings broker = BrokerSettings.defaults();
    private ComponentObserver components = ComponentObserver.logging();
    private Consumer<ApplicationEvent> events = event -> {};

    private ApplicationSettings() {}

    /** A reconnect limit of 3 s, which is enough for the broker to restart a provider; problems are logged. */
    public static ApplicationSettings defaults() {
        return DEFAULTS;
    }

    @Override
    protected void check() {
        if (reconnectLimit.isNegative() || reconnectLimit.isZero()) {
            throw new IllegalArgumentException("reconnectLimit is " + reconnectLimit + ", expected more than zero");
        }
    }

    /** How long a user may be without a provider after the loss of one. */
    public ApplicationSettings withReconnectLimit(Duration limit) {
        Objects.requireNonNull(limit, "reconnectLimit");
        return with(copy -> copy.reconnectLimit = limit);
    }

    /** Limits, checks and observer of the broker. */
    public ApplicationSettings withBroker(BrokerSettings settings) {
        Objects.requireNonNull(settings, "broker");
        return with(copy -> copy.broker = settings);
    }

    /** Is notified of the events of components. */
    public ApplicationSettings withComponentObserver(ComponentObserver observer) {
        Objects.requireNonNull(observer, "components");
        return with(copy -> copy.components = observer);
    }

    /** Is notified of the events of the application. */
    public ApplicationSettings withObserver(Consumer<ApplicationEvent> observer) {
        Objects.requireNonNull(observer, "events");
        return with(copy -> copy.events = observer);
    }

    public Duration reconnectLimit() {
        return reconnectLimit;
    }

    public BrokerSettings broker() {
        return broker;
    }

    public ComponentObserver components() {
        return components;
    }

    public Consumer<ApplicationEvent> events() {
        return events;
    }
}
