package io.troupe.bench;

import java.util.concurrent.locks.LockSupport;

/** Notifies the outside thread that the last message was handled, in the same way for all contenders. */
final class CompletionLatch {
    private static final int SPINS = 500;
    private static final int NAP_NANOS = 10_000;

    private volatile boolean reached;

    void reset() {
        reached = false;
    }

    void reach() {
        reached = true;
    }

    void await() {
        for (int spins = 0; !reached; spins++) {
            if (spins < SPINS) {
                Thread.onSpinWait();
            } else {
                LockSupport.parkNanos(NAP_NANOS);
            }
        }
    }
}
