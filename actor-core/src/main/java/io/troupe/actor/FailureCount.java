package io.troupe.actor;

import java.time.Duration;
import java.util.ArrayDeque;

/** Counts an actor's failures within the window of its supervision. On the space's thread. */
final class FailureCount {
    private final Supervision supervision;
    private final ArrayDeque<Long> recent = new ArrayDeque<>();

    FailureCount(Supervision supervision) {
        this.supervision = supervision;
    }

    /** Counts a failure and returns the directive for it. */
    Supervision.Directive note(long nowNanos) {
        if (supervision.limit() == Integer.MAX_VALUE) {
            return supervision.directive();
        }
        while (!recent.isEmpty() && isOver(nowNanos - recent.peekFirst())) {
            recent.removeFirst();
        }
        recent.addLast(nowNanos);
        return recent.size() > supervision.limit() ? Supervision.Directive.STOP : supervision.directive();
    }

    /** Compares durations: a window may exceed the range of nanoseconds in a long. */
    private boolean isOver(long agoNanos) {
        return Duration.ofNanos(agoNanos).compareTo(supervision.window()) >= 0;
    }
}
