package io.troupe.actor.promise;

import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.NoSuchElementException;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;

/** Promises about several promises. */
final class Gather {
    private Gather() {}

    static <T extends @Nullable Object> Promise<List<T>> all(Collection<? extends Promise<? extends T>> promises) {
        var parts = List.<Promise<? extends T>>copyOf(promises);
        var whole = new Deferred<List<T>>();
        if (parts.isEmpty()) {
            whole.resolve(List.of());
        }
        var pending = new AtomicInteger(parts.size());
        for (var part : parts) {
            part.register(new Relay(() -> {
                Throwable error = part.error();
                if (error != null) {
                    whole.reject(error);
                } else if (pending.decrementAndGet() == 0) {
                    var values = new ArrayList<T>(parts.size());
                    parts.forEach(each -> values.add(Stage.present(each.getNow())));
                    whole.resolve(values);
                }
            }));
        }
        return whole;
    }

    static <T extends @Nullable Object> Promise<List<Outcome<T>>> allSettled(
            Collection<? extends Promise<? extends T>> promises) {
        var parts = List.<Promise<? extends T>>copyOf(promises);
        var whole = new Deferred<List<Outcome<T>>>();
        if (parts.isEmpty()) {
            whole.resolve(List.of());
        }
        var pending = new AtomicInteger(parts.size());
        for (var part : parts) {
            part.register(new Relay(() -> {
                if (pending.decrementAndGet() == 0) {
                    var outcomes = new ArrayList<Outcome<T>>(parts.size());
                    parts.forEach(each -> outcomes.add(widen(each.outcome())));
                    whole.resolve(outcomes);
                }
            }));
        }
        return whole;
    }

    static <T extends @Nullable Object> Promise<T> any(Collection<? extends Promise<? extends T>> promises) {
        var parts = List.<Promise<? extends T>>copyOf(promises);
        var first = new Deferred<T>();
        if (parts.isEmpty()) {
            first.reject(new NoSuchElementException("any of no promises"));
        }
        var pending = new AtomicInteger(parts.size());
        for (var part : parts) {
            part.register(new Relay(() -> {
                if (!part.isRejected()) {
                    first.resolve(Stage.present(part.getNow()));
                } else if (pending.decrementAndGet() == 0) {
                    var error = new NoSuchElementException("none of " + parts.size() + " promises was fulfilled");
                    parts.forEach(each -> error.addSuppressed(each.error()));
                    first.reject(error);
                }
            }));
        }
        return first;
    }

    static <T extends @Nullable Object> Promise<T> race(Collection<? extends Promise<? extends T>> promises) {
        var first = new Deferred<T>();
        for (var part : promises) {
            first.follow(part);
        }
        return first;
    }

    @SuppressWarnings("unchecked") // an outcome is read only
    private static <T extends @Nullable Object> Outcome<T> widen(Outcome<? extends T> outcome) {
        return (Outcome<T>) outcome;
    }
}
