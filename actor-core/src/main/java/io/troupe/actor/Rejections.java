package io.troupe.actor;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.TimerWheel;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** The promises that were rejected without a listener, until they are reported. On the space's thread. */
final class Rejections {
    private record Lost(Promise<?> promise, Throwable error) {}

    private static final long GRACE_NANOS = 1_000_000_000;

    private final TimerWheel timers;
    private final Reports reports;
    private final List<Lost> lost = new ArrayList<>();
    private final Map<Promise<?>, Throwable> held = new LinkedHashMap<>();

    Rejections(TimerWheel timers, Reports reports) {
        this.timers = timers;
        this.reports = reports;
    }

    void add(Promise<?> promise, Throwable error) {
        lost.add(new Lost(promise, error));
    }

    /** Keeps a rejection for a while, because its caller on another thread may be about to register a listener. */
    void hold(Promise<?> promise, Throwable error) {
        held.put(promise, error);
        timers.set(() -> release(promise), GRACE_NANOS, 0);
    }

    private void release(Promise<?> promise) {
        Throwable error = held.remove(promise);
        if (error != null) {
            add(promise, error);
        }
    }

    void releaseAll() {
        List.copyOf(held.keySet()).forEach(this::release);
    }

    /** Reports the promises that still have no listener. */
    void report() {
        if (lost.isEmpty()) {
            return;
        }
        var candidates = List.copyOf(lost);
        lost.clear();
        for (var candidate : candidates) {
            if (!SpaceHome.isListenedTo(candidate.promise)) {
                reports.error("a promise nobody listens to:", candidate.promise, candidate.error, null);
            }
        }
    }
}
