package io.troupe.actor.time;

import org.jspecify.annotations.Nullable;

/**
 * A task with a deadline, as returned by {@code after(..)} and {@code every(..)} of an actor.
 *
 * {@snippet :
 * public void pause() {
 *     if (cycle != null) {
 *         cycle.cancel();
 *     }
 * }
 * }
 *
 * <p><b>Threads.</b> The thread of its space.
 */
public final class Timer {
    /** The place of a timer that is neither in a slot nor in the heap. */
    static final int NOWHERE = -1;

    final Runnable task;
    final long periodNanos;
    final Schedule schedule;
    final long sequence;
    long deadlineNanos;
    boolean waiting = true;
    int place = NOWHERE; // the index in the heap if it is near, else the index of its slot
    boolean near;

    @Nullable
    Timer before; // links within its slot

    @Nullable
    Timer after;

    private final TimerWheel wheel;

    Timer(TimerWheel wheel, Runnable task, long deadlineNanos, long periodNanos, Schedule schedule, long sequence) {
        this.wheel = wheel;
        this.task = task;
        this.deadlineNanos = deadlineNanos;
        this.periodNanos = periodNanos;
        this.schedule = schedule;
        this.sequence = sequence;
    }

    /**
     * Cancels the task.
     *
     * @return false if it has run (and is not periodic) or was cancelled before
     * @throws IllegalStateException on a thread other than that of its space
     */
    public boolean cancel() {
        return wheel.cancel(this);
    }

    /** True if it has not run and was not cancelled. */
    public boolean isWaiting() {
        return waiting;
    }
}
