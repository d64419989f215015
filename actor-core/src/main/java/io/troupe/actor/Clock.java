package io.troupe.actor;

/**
 * A source of time, with a callback for clocks that are moved by hand.
 *
 * {@snippet :
 * Clock clock = space.clock();
 * long startNanos = clock.nanos();
 * space.delay(Duration.ofSeconds(2))
 *         .thenRun(() -> log.add("after " + Duration.ofNanos(clock.nanos() - startNanos)));
 * }
 *
 * <p><b>Threads.</b> Any thread. <b>Units and shapes.</b> Nanoseconds since a fixed but arbitrary moment, never
 * decreasing.
 */
public interface Clock {
    long nanos();

    /**
     * Calls {@code wake} after every move of a clock that is moved by hand; a clock that runs by itself never calls it.
     *
     * @return removes the registration
     */
    Runnable onMove(Runnable wake);

    /** True if time passes by itself, so that waiting for a moment means sleeping. */
    boolean runsByItself();

    /** The machine's monotonic clock. */
    static Clock system() {
        return SystemClock.INSTANCE;
    }
}

/** The machine's monotonic clock. */
enum SystemClock implements Clock {
    INSTANCE;

    @Override
    public long nanos() {
        return System.nanoTime();
    }

    @Override
    public Runnable onMove(Runnable wake) {
        return () -> {};
    }

    @Override
    public boolean runsByItself() {
        return true;
    }
}
