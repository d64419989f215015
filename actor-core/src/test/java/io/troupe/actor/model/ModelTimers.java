package io.troupe.actor.model;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.function.Consumer;

/** Timers in a list; time is counted in half milliseconds. */
final class ModelTimers {
    static final class Timer {
        private final Runnable task;
        private final Runnable ifClosed;
        private final int period;
        private final int number;
        private long deadline;
        private boolean waiting = true;

        Timer(Runnable task, Runnable ifClosed, long deadline, int period, int number) {
            this.task = task;
            this.ifClosed = ifClosed;
            this.deadline = deadline;
            this.period = period;
            this.number = number;
        }

        boolean cancel() {
            boolean inTime = waiting;
            waiting = false;
            return inTime;
        }
    }

    private final List<Timer> timers = new ArrayList<>();
    long now;

    Timer set(long delay, int period, Runnable task, Runnable ifClosed) {
        var timer = new Timer(task, ifClosed, now + Math.max(0, delay), period, timers.size());
        timers.add(timer);
        return timer;
    }

    boolean isDue() {
        return timers.stream().anyMatch(each -> each.waiting && each.deadline <= now);
    }

    private List<Timer> inTurn(long until) {
        return timers.stream()
                .filter(each -> each.waiting && each.deadline <= until)
                .sorted(Comparator.<Timer>comparingLong(each -> each.deadline).thenComparingInt(each -> each.number))
                .toList();
    }

    /** Drops all timers, in the order in which they would have run. */
    void clear() {
        var dropped = inTurn(Long.MAX_VALUE);
        dropped.forEach(Timer::cancel);
        dropped.forEach(each -> each.ifClosed.run());
    }

    /** Runs each due timer once, by deadline and then in the order in which they were set. */
    boolean runDue(Consumer<Runnable> turn) {
        var due = inTurn(now);
        for (var timer : due) {
            if (timer.waiting) {
                timer.waiting = timer.period > 0;
                timer.deadline += timer.period;
                turn.accept(timer.task);
            }
        }
        return !due.isEmpty();
    }
}
