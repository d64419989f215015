package io.troupe.actor;

import io.troupe.actor.promise.Promise;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.BiConsumer;

/** Promises that were rejected while nobody listened, until it is fair to say that nobody does. On the space's thread. */
final class Rejections {
    private record Lost(Promise<?> promise, Throwable error) {}

    private final List<Lost> lost = new ArrayList<>();
    private final Map<Promise<?>, Throwable> held = new LinkedHashMap<>();

    void add(Promise<?> promise, Throwable error) {
        lost.add(new Lost(promise, error));
    }

    /** Keeps one whose asker, on another thread, may be just about to listen. */
    void hold(Promise<?> promise, Throwable error) {
        held.put(promise, error);
    }

    void release(Promise<?> promise) {
        Throwable error = held.remove(promise);
        if (error != null) {
            add(promise, error);
        }
    }

    void releaseAll() {
        List.copyOf(held.keySet()).forEach(this::release);
    }

    /** Reports those that still have no listener. */
    void report(BiConsumer<Promise<?>, Throwable> reporter) {
        if (lost.isEmpty()) {
            return;
        }
        var candidates = List.copyOf(lost);
        lost.clear();
        for (var candidate : candidates) {
            if (!ActorSpace.isListenedTo(candidate.promise)) {
                reporter.accept(candidate.promise, candidate.error);
            }
        }
    }
}
