package io.troupe.actor;

import io.troupe.actor.time.Schedule;
import io.troupe.actor.time.Timer;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * The keyed timers of one actor: at most one per key. On the space's thread.
 *
 * <p><b>Cost.</b> Amortized constant time: timers that were cancelled by their handle are removed whenever the map has
 * doubled.
 */
final class KeyedTimers {
    private static final int SMALL = 16;

    private @Nullable Map<Object, Timer> timers; // most actors have none
    private int sweepAt = SMALL;

    Timer set(ActorCell cell, Object key, Duration delay, Duration period, Schedule schedule, Runnable task) {
        Objects.requireNonNull(key, "key");
        Objects.requireNonNull(task, "task");
        var known = timers == null ? timers = new HashMap<>() : timers;
        boolean once = period.isZero();
        Timer timer = cell.space().timer(cell, delay, period, schedule, () -> {
            if (once) {
                known.remove(key); // first, because the task may set the key again
            }
            task.run();
        });
        Timer before = known.put(key, timer);
        if (before != null) {
            before.cancel();
        } else if (known.size() >= sweepAt) {
            known.values().removeIf(each -> !each.isWaiting());
            sweepAt = Math.max(SMALL, 2 * known.size());
        }
        return timer;
    }

    boolean cancel(Object key) {
        Objects.requireNonNull(key, "key");
        Timer timer = timers == null ? null : timers.remove(key);
        return timer != null && timer.cancel();
    }

    void cancelAll() {
        if (timers != null) {
            timers.values().forEach(Timer::cancel);
            timers.clear();
        }
    }

    /** The number of stored timers: those that are waiting, and at most as many that were cancelled by their handle. */
    int size() {
        return timers == null ? 0 : timers.size();
    }
}
