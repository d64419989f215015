package io.troupe.services.broker;

import java.time.Duration;
import java.util.List;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/** Restarts failed providers that a connection waits for, after increasing pauses. Runs on the broker's space. */
final class Restarts {
    private final BrokerSettings settings;
    private final Limits limits;
    private final Lifecycle lifecycle;
    private final Predicate<Registration> wanted;

    Restarts(BrokerSettings settings, Limits limits, Lifecycle lifecycle, Predicate<Registration> wanted) {
        this.settings = settings;
        this.limits = limits;
        this.lifecycle = lifecycle;
        this.wanted = wanted;
    }

    void consider(List<Registration> some) {
        some.forEach(this::consider);
    }

    private void consider(Registration it) {
        if (settings.restartPause().isZero()
                || it.health != Health.FAILED
                || it.nextRestart != null
                || lifecycle.isClosing()
                || !wanted.test(it)) {
            return;
        }
        Duration pause = next(it.restartPause);
        it.restartPause = pause;
        it.nextRestart = limits.after(pause, () -> {
            it.nextRestart = null;
            if (it.health == Health.FAILED && !lifecycle.isClosing() && wanted.test(it)) {
                lifecycle.start(it).handle((started, error) -> {
                    consider(it);
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
