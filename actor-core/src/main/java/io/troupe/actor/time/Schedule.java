package io.troupe.actor.time;

/**
 * When a periodic timer runs next, in particular if it was late because its thread was busy.
 *
 * <p>The deadlines of the first two are one period apart, however long the runs take; only {@link #FIXED_DELAY} counts
 * from the end of a run.
 *
 * {@snippet :
 * cycle = every(Duration.ofMillis(100), Schedule.SKIP_MISSED, () -> log.add("cycle"));
 * }
 */
public enum Schedule {
    /**
     * A run for every period, the default. A timer that is late makes up for the runs it has missed, one in each pass
     * through the queues, so that messages are served in between. On a clock that runs by itself it makes up for the
     * last second only, and leaves out what is older, so that a stall of a minute is not followed by thousands of runs
     * at once. On a clock that is moved by hand it leaves out nothing: the number of runs does not depend on how far
     * the clock is moved at a time.
     */
    FIXED_RATE,

    /**
     * As {@link #FIXED_RATE}, but missed runs are left out: a late timer runs once, and then at the next deadline to
     * come. For control loops.
     */
    SKIP_MISSED,

    /** The next run is due one period after the end of the run before. For work that needs a pause, such as polling. */
    FIXED_DELAY
}
