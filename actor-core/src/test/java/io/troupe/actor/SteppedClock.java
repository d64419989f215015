package io.troupe.actor;

/** Runs by itself from the point of view of a space or a wheel, so that a timer can be late; the test moves it. */
public final class SteppedClock implements Clock {
    public long nanos;

    @Override
    public long nanos() {
        return nanos;
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
