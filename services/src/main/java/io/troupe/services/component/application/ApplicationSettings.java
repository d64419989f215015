package io.troupe.services.component.application;

import io.troupe.services.component.ComponentObserver;
import java.time.Duration;
import java.util.function.Consumer;

/**
 * How an application is run; immutable.
 *
 * @param patience how long a user may be without a provider that it had
 * @param components hears what becomes of components
 * @param events hears what happens in the application
 */
public record ApplicationSettings(Duration patience, ComponentObserver components, Consumer<ApplicationEvent> events) {
    /** 3 s of patience, enough for the broker to start a provider again; problems are logged. */
    public static final ApplicationSettings DEFAULT =
            new ApplicationSettings(Duration.ofSeconds(3), ComponentObserver.LOG, event -> {});

    public ApplicationSettings withPatience(Duration newPatience) {
        return new ApplicationSettings(newPatience, components, events);
    }

    public ApplicationSettings withObservers(ComponentObserver newComponents, Consumer<ApplicationEvent> newEvents) {
        return new ApplicationSettings(patience, newComponents, newEvents);
    }
}
