package io.troupe.actor.time;

import org.jspecify.annotations.Nullable;

/**
 * A task that waits for its deadline: what {@code after(..)} and {@code every(..)} of an actor return.
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
    /** The place of a timer that is neither on the wheel nor in its heap. */
    static final int NOWHERE = -1;

    final Runnable task;
    final long periodNanos;
    final Schedule schedule;
    final long sequence;
    long deadlineNanos;
    boolean waiting = true;
    int place = NOWHERE; // in the heap if it is near, else the number of its slot
    boolean near;

    @Nullable
    Timer before; // in its slot

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
     * Takes the task back.
     *
     * @return false if it has run (and is not periodic) or was cancelled before
     * @throws IllegalStateException on another thread than that of its space
     */
    public boolean cancel() {
        return wheel.cancel(this);
    }

    /** Whether it is still going to run. */
    public boolean isWaiting() {
        return waiting;
    }
}
