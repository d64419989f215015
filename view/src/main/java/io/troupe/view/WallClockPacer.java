package io.troupe.view;

import io.troupe.actor.Clock;
import java.util.concurrent.locks.LockSupport;

/** Slows a simulation down to real time, which begins when this object is created. */
public final class WallClockPacer {
    private final long originNanos = Clock.system().nanos();

    /** Waits until as much real time has passed as simulated time. */
    public void await(long simulatedMicros) {
        long deadlineNanos = originNanos + simulatedMicros * 1000;
        for (long left = deadlineNanos - Clock.system().nanos();
                left > 0;
                left = deadlineNanos - Clock.system().nanos()) {
            LockSupport.parkNanos(left);
        }
    }
}
