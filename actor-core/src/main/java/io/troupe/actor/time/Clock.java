package io.troupe.actor.time;

/**
 * Tells the time to whoever waits.
 *
 * <p><b>Threads.</b> Any thread. <b>Units and shapes.</b> Nanoseconds since a fixed but arbitrary moment, never going
 * back.
 */
public interface Clock {
    long nanos();

    /**
     * Calls {@code wake} after every move of a clock that is moved by hand; a clock that runs by itself never calls.
     *
     * @return takes the registration back
     */
    Runnable onMove(Runnable wake);

    /** Whether time passes by itself, so that waiting for a moment means sleeping. */
    boolean runsByItself();

    /** The machine's monotonic clock. */
    static Clock system() {
        return SystemClock.INSTANCE;
    }
}
