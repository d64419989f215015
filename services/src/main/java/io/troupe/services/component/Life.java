package io.troupe.services.component;

import io.troupe.actor.promise.Promise;
import java.util.Objects;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * One run of the component, from invocation to termination. Calls its CCU and converts the exceptions and errors that
 * it throws to rejected promises, except those of {@link #data}.
 */
final class Life<I, O> {
    private final ComponentCommunication<I, O> communication;
    private volatile boolean over;

    Life(ComponentCommunication<I, O> communication) {
        this.communication = communication;
    }

    Promise<@Nullable Void> invoke(ComponentCommunication.Signals<? super O> signals) {
        return attempt(() -> communication.invoke(signals));
    }

    Promise<@Nullable Void> terminate() {
        return attempt(communication::terminate);
    }

    Promise<@Nullable Void> health() {
        return attempt(communication::health);
    }

    void data(I input) {
        communication.data(input);
    }

    /** True once the run is over, so that later signals must be ignored. Any thread. */
    boolean isOver() {
        return over;
    }

    void end() {
        over = true;
    }

    private static Promise<@Nullable Void> attempt(Supplier<? extends @Nullable Promise<@Nullable Void>> action) {
        try {
            return Objects.requireNonNull(action.get(), "it answered null, expected a promise");
        } catch (RuntimeException | Error thrown) {
            return Promise.failed(thrown);
        }
    }
}
