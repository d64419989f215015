package io.troupe.actor;

import io.troupe.actor.time.Schedule;
import io.troupe.actor.time.Timer;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * The timers of one actor that are known by a key: one for each key at the most. On the space's thread.
 *
 * <p><b>Cost.</b> Constant time, averaged over many calls: timers that were cancelled by their handle are swept out
 * whenever the map has doubled.
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
                known.remove(key); // before, for the task may set the key anew
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

    /** How many are remembered: those that wait, and at most as many again that were cancelled by their handle. */
    int size() {
        return timers == null ? 0 : timers.size();
    }
}
