package io.troupe.actor;

/**
 * When a periodic timer runs next, in particular after a run that was late because its thread was busy.
 *
 * <p>The deadlines of the first two schedules are one period apart, independent of the duration of a run; only
 * {@link #FIXED_DELAY} counts from the end of a run.
 *
 * {@snippet :
 * cycle = context().every(Duration.ofMillis(100), Schedule.SKIP_MISSED, () -> log.add("cycle"));
 * }
 */
public enum Schedule {
    /**
     * One run for every period; the default. A late timer catches up on missed runs, one in each pass through the
     * queues, so that messages are processed in between. On a clock that runs by itself it catches up on the last
     * second only, so that a stall of a minute is not followed by thousands of runs at once. On a clock that is moved
     * by hand no run is dropped: the number of runs does not depend on the size of the steps.
     */
    FIXED_RATE,

    /**
     * Like {@link #FIXED_RATE}, but missed runs are dropped: a late timer runs once, and then at the next deadline. For
     * control loops.
     */
    SKIP_MISSED,

    /**
     * The next run is due one period after the end of the previous run. For work that needs a pause, such as polling.
     */
    FIXED_DELAY
}
