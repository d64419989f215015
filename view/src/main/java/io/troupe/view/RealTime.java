package io.troupe.view;

import java.util.concurrent.locks.LockSupport;

/** Slows a simulation down to real time, which begins when this object is created. */
public final class RealTime {
    private final long originNanos = System.nanoTime();

    /** Waits until as much real time has passed as simulated time. */
    public void await(long simulatedMicros) {
        long deadlineNanos = originNanos + simulatedMicros * 1000;
        for (long left = deadlineNanos - System.nanoTime(); left > 0; left = deadlineNanos - System.nanoTime()) {
            LockSupport.parkNanos(left);
        }
    }
}
