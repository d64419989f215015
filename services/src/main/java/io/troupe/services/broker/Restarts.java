package io.troupe.services.broker;

import java.time.Duration;
import java.util.List;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/** Restarts failed providers that a connection waits for, after increasing pauses. Runs on the broker's space. */
final class Restarts {
    private final BrokerSettings settings;
    private final Timeouts timeouts;
    private final Supervisor supervisor;
    private final Predicate<Registration> wanted;

    Restarts(BrokerSettings settings, Timeouts timeouts, Supervisor supervisor, Predicate<Registration> wanted) {
        this.settings = settings;
        this.timeouts = timeouts;
        this.supervisor = supervisor;
        this.wanted = wanted;
    }

    void consider(List<Registration> some) {
        some.forEach(this::consider);
    }

    private void consider(Registration registration) {
        if (settings.restartPause().isZero()
                || registration.health != Health.FAILED
                || registration.nextRestart != null
                || supervisor.isClosing()
                || !wanted.test(registration)) {
            return;
        }
        Duration pause = next(registration.restartPause);
        registration.restartPause = pause;
        registration.nextRestart = timeouts.after(pause, () -> {
            registration.nextRestart = null;
            if (registration.health == Health.FAILED && !supervisor.isClosing() && wanted.test(registration)) {
                supervisor.start(registration).handle((started, error) -> {
                    consider(registration);
                    return null;
                });
            }
        });
    }

    private Duration next(@Nullable Duration before) {
        if (before == null) {
            return settings.restartPause();
        }
        Duration twice = before.multipliedBy(2);
        return twice.compareTo(settings.longestRestartPause()) < 0 ? twice : settings.longestRestartPause();
    }
}
