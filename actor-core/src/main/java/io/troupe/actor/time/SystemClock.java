package io.troupe.actor.time;

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
