package io.troupe.broker;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.Timer;
import java.time.Duration;
import java.util.Objects;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** Calls providers with a time limit. Runs on the broker's space. */
final class Timeouts {
    /** The timers of the broker's actor. */
    interface Timers {
        Timer after(Duration delay, Runnable task);
    }

    private final Timers timers;

    Timeouts(Timers timers) {
        this.timers = timers;
    }

    Timer after(Duration delay, Runnable task) {
        return timers.after(delay, task);
    }

    /**
     * Calls a provider.
     *
     * @param late receives an answer (null) or an error that came after the limit
     * @return settled like the provider's answer; rejected with an overdue {@link ProviderException} if the limit is
     *     over first
     */
    Promise<@Nullable Void> call(
            Supplier<? extends @Nullable Promise<?>> call,
            Duration limit,
            String overdue,
            Consumer<@Nullable Throwable> late) {
        var outcome = new Deferred<@Nullable Void>();
        Promise<?> answer = answerOf(call);
        Timer timer = timers.after(
                limit, () -> outcome.reject(ProviderException.overdue(overdue + " within " + limit, null)));
        answer.onSettled((value, error) -> {
            timer.cancel();
            if (error == null ? !outcome.resolve(null) : !outcome.reject(error)) {
                late.accept(error);
            }
        });
        return outcome;
    }

    private static Promise<?> answerOf(Supplier<? extends @Nullable Promise<?>> call) {
        try {
            return Objects.requireNonNull(call.get(), "it returned null, expected a promise");
        } catch (Throwable thrown) { // an exception from a provider counts as its answer
            return Promise.failed(thrown);
        }
    }
}
