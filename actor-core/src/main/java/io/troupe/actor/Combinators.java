package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.NoSuchElementException;
import java.util.Objects;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Combinators over several promises. The result belongs to the calling space, else to the home of the first part that
 * has one.
 */
final class Combinators {
    private Combinators() {}

    private static <P> List<P> parts(Collection<? extends P> promises) {
        var parts = new ArrayList<P>(Objects.requireNonNull(promises, "promises"));
        for (int index = 0; index < parts.size(); index++) {
            if (parts.get(index) == null) {
                throw new NullPointerException("promises[" + index + "]");
            }
        }
        return parts;
    }

    private static <R extends @Nullable Object> Deferred<R> about(List<? extends Promise<?>> parts) {
        return about(parts, null);
    }

    private static <R extends @Nullable Object> Deferred<R> about(
            List<? extends Promise<?>> parts, @Nullable Runnable ifCancelled) {
        Home here = Home.current();
        Home home = here != null
                ? here
                : parts.stream()
                        .map(Promise::home)
                        .filter(Objects::nonNull)
                        .findFirst()
                        .orElse(null);
        return new Deferred<>(home, ifCancelled);
    }

    static <T extends @Nullable Object> Promise<List<T>> all(Collection<? extends Promise<? extends T>> promises) {
        List<Promise<? extends T>> parts = parts(promises);
        Deferred<List<T>> whole = about(parts);
        if (parts.isEmpty()) {
            whole.resolve(List.of());
        }
        var pending = new AtomicInteger(parts.size());
        for (var part : parts) {
            part.register(new Listeners.Inline(
                    () -> {
                        Throwable error = part.error();
                        if (error != null) {
                            whole.reject(error);
                        } else if (pending.decrementAndGet() == 0) {
                            var values = new ArrayList<T>(parts.size());
                            parts.forEach(each -> values.add(Stage.present(each.getNow())));
                            whole.resolve(values);
                        }
                    },
                    whole));
        }
        return whole;
    }

    @SuppressWarnings("unchecked") // the caller has the same type for both
    static Promise<?> ofRequests(Promise<?> first, Promise<?> second) {
        var parts = (List<Promise<Object>>) (List<?>) List.of(first, second);
        Deferred<Object> whole = about(parts, () -> parts.forEach(Promise::cancel));
        whole.resolveFrom(all(parts).thenApply(values -> values.get(0)));
        return whole;
    }

    static <T extends @Nullable Object> Promise<List<Outcome<T>>> allSettled(
            Collection<? extends Promise<? extends T>> promises) {
        List<Promise<? extends T>> parts = parts(promises);
        Deferred<List<Outcome<T>>> whole = about(parts);
        if (parts.isEmpty()) {
            whole.resolve(List.of());
        }
        var pending = new AtomicInteger(parts.size());
        for (var part : parts) {
            part.register(new Listeners.Inline(
                    () -> {
                        if (pending.decrementAndGet() == 0) {
                            var outcomes = new ArrayList<Outcome<T>>(parts.size());
                            parts.forEach(each -> outcomes.add(widen(each.outcome())));
                            whole.resolve(outcomes);
                        }
                    },
                    whole));
        }
        return whole;
    }

    static <T extends @Nullable Object> Promise<T> any(Collection<? extends Promise<? extends T>> promises) {
        List<Promise<? extends T>> parts = parts(promises);
        Deferred<T> first = about(parts);
        if (parts.isEmpty()) {
            first.reject(new NoSuchElementException("any of no promises"));
        }
        var pending = new AtomicInteger(parts.size());
        for (var part : parts) {
            part.register(new Listeners.Inline(
                    () -> {
                        if (!part.isRejected()) {
                            first.resolve(Stage.present(part.getNow()));
                        } else if (pending.decrementAndGet() == 0) {
                            var error =
                                    new NoSuchElementException("none of " + parts.size() + " promises was fulfilled");
                            parts.forEach(each -> error.addSuppressed(each.error()));
                            first.reject(error);
                        }
                    },
                    first));
        }
        return first;
    }

    static <T extends @Nullable Object> Promise<T> race(Collection<? extends Promise<? extends T>> promises) {
        List<Promise<? extends T>> parts = parts(promises);
        Deferred<T> first = about(parts);
        if (parts.isEmpty()) {
            first.reject(new NoSuchElementException("race of no promises"));
        }
        parts.forEach(first::follow);
        return first;
    }

    /** Rejected with the error after the promise of the action, or with an error of the action. */
    static <T extends @Nullable Object> Promise<T> finallyFailed(
            Supplier<? extends Promise<?>> action, Throwable error) {
        Promise<?> last;
        try {
            last = Objects.requireNonNull(action.get(), "the function returned null, not a promise");
        } catch (Throwable thrown) {
            throw suppressing(thrown, error);
        }
        return last.handle((value, again) -> {
            throw again == null ? QueueEntries.rethrow(error) : suppressing(again, error);
        });
    }

    private static RuntimeException suppressing(Throwable last, Throwable first) {
        if (last != first) {
            last.addSuppressed(first);
        }
        return QueueEntries.rethrow(last);
    }

    @SuppressWarnings("unchecked") // an outcome is read-only
    private static <T extends @Nullable Object> Outcome<T> widen(Outcome<? extends T> outcome) {
        return (Outcome<T>) outcome;
    }
}
