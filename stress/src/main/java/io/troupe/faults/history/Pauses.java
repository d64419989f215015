package io.troupe.faults.history;

import io.troupe.faults.history.Event.Paused;
import io.troupe.faults.history.History.Entry;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** When the processes of a run did not run, and how long they lived. */
final class Pauses {
    private record Interval(long fromNanos, long toNanos) {}

    private final Map<String, List<Interval>> pauses = new HashMap<>();
    private final Map<String, Long> last = new HashMap<>();

    Pauses(History history) {
        for (Entry entry : history.entries()) {
            last.put(entry.process(), entry.nanos());
            if (entry.event() instanceof Paused(long nanos)) {
                pauses.computeIfAbsent(entry.process(), process -> new ArrayList<>())
                        .add(new Interval(entry.nanos() - nanos, entry.nanos()));
            }
        }
    }

    /** How long a process ran between two moments. */
    long runningNanos(String process, long fromNanos, long toNanos) {
        long running = toNanos - fromNanos;
        for (Interval pause : pauses.getOrDefault(process, List.of())) {
            running -= Math.max(0, Math.min(toNanos, pause.toNanos) - Math.max(fromNanos, pause.fromNanos));
        }
        return running;
    }

    /**
     * The time from one moment to another, without the pauses before which the process ran for a while: what it had
     * accepted by then, it may begin after the pause.
     */
    long sinceAcceptedNanos(String process, long fromNanos, long toNanos) {
        return toNanos
                - fromNanos
                - pauses.getOrDefault(process, List.of()).stream()
                        .filter(pause -> pause.fromNanos > fromNanos && pause.toNanos <= toNanos)
                        .filter(pause -> runningNanos(process, fromNanos, pause.fromNanos) > 0)
                        .mapToLong(pause -> pause.toNanos - pause.fromNanos)
                        .sum();
    }

    /** The moment, or the end of the pause in which it is: a process that is frozen there goes on then. */
    long runsAgainAt(String process, long nanos) {
        return pauses.getOrDefault(process, List.of()).stream()
                .filter(pause -> pause.fromNanos <= nanos && nanos < pause.toNanos)
                .mapToLong(Interval::toNanos)
                .findAny()
                .orElse(nanos);
    }

    /** The time of the last event of a process. */
    long lastNanos(String process) {
        return last.getOrDefault(process, Long.MIN_VALUE);
    }
}
