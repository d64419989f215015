package io.troupe.actor;

import java.util.ArrayDeque;

/** Counts an actor's failures within the window of its supervision. On the space's thread. */
final class FailureCount {
    private final Supervision supervision;
    private final ArrayDeque<Long> recent = new ArrayDeque<>();

    FailureCount(Supervision supervision) {
        this.supervision = supervision;
    }

    /** Notes a failure and answers what to do about it. */
    Supervision.Directive note(long nowNanos) {
        if (supervision.limit() == Integer.MAX_VALUE) {
            return supervision.directive();
        }
        long oldest = nowNanos - supervision.window().toNanos();
        while (!recent.isEmpty() && recent.peekFirst() <= oldest) {
            recent.removeFirst();
        }
        recent.addLast(nowNanos);
        return recent.size() > supervision.limit() ? Supervision.Directive.STOP : supervision.directive();
    }
}
