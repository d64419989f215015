package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.Objects;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** Repeats an attempt until it succeeds. A loop, so that it retains nothing of failed attempts. */
final class Retry<T extends @Nullable Object> {
    private final ActorSpace space;
    private final Duration pause;
    private final Supplier<? extends Promise<? extends T>> attempt;
    private final Deferred<T> end;
    private int left;
    private volatile @Nullable Promise<?> pausing;

    private Retry(ActorSpace space, int tries, Duration pause, Supplier<? extends Promise<? extends T>> attempt) {
        this.space = space;
        this.left = tries;
        this.pause = Objects.requireNonNull(pause, "pause");
        this.attempt = Objects.requireNonNull(attempt, "attempt");
        this.end = space.deferred(this::cancelled);
    }

    static <T extends @Nullable Object> Promise<T> start(
            ActorSpace space, int tries, Duration pause, Supplier<? extends Promise<? extends T>> attempt) {
        var retrial = new Retry<T>(space, tries, pause, attempt);
        retrial.tryNow();
        return retrial.end;
    }

    private void cancelled() {
        Promise<?> now = pausing;
        if (now != null) {
            now.cancel();
        }
    }

    private void tryNow() {
        Promise<T> trial = Promise.done().thenCompose(begin -> attempt.get());
        next(space, trial, failure -> ended(trial, failure), end);
    }

    private @Nullable Void ended(Promise<T> trial, @Nullable Throwable failure) {
        if (failure == null) {
            end.resolveFrom(trial);
        } else if (--left == 0) {
            end.reject(failure);
        } else if (!end.isDone()) {
            Promise<?> delay = space.delay(pause);
            pausing = delay;
            next(space, delay, this::paused, end);
            if (end.isDone()) {
                delay.cancel(); // cancelled while the pause began
            }
        }
        return null;
    }

    private @Nullable Void paused(@Nullable Throwable failure) {
        if (failure != null) {
            end.reject(failure);
        } else if (!end.isDone()) {
            tryNow();
        }
        return null;
    }

    /**
     * Registers the next step of a loop. If the actor on whose behalf it is registered stops first, the listener is not
     * called, and the loop's promise is rejected.
     */
    static void next(
            ActorSpace space,
            Promise<?> step,
            Function<@Nullable Throwable, @Nullable Void> listener,
            Deferred<?> end) {
        Promise<?> result = step.handle((value, error) -> listener.apply(error));
        space.whenPromiseSettled(result, end::isDone, () -> {
            Throwable error = result.error();
            if (error != null) {
                end.reject(error);
            }
        });
    }
}
