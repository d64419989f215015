package io.troupe.actor;

import io.troupe.actor.time.Clock;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/**
 * Whether a space is awake, asleep or closed, and how it is woken.
 *
 * <p><b>Threads.</b> {@link #wake} from any thread, after it has queued something; the rest on the space's.
 */
final class Lifeline {
    /*
     * No wake-up is lost: the sleeper first says that it sleeps and then looks at its queues again; the waker first queues and then looks
     * whether the other sleeps. Both are sequentially consistent, so at least one of them sees the other. The waker resets the flag itself,
     * so that one sleep costs one unpark, however many messages arrive before the thread really runs.
     */
    private static final int AWAKE = 0;
    private static final int ASLEEP = 1;
    private static final int CLOSED = 2;
    private static final int SPINS = 100;

    private final AtomicInteger phase = new AtomicInteger(AWAKE);
    private volatile @Nullable Thread sleeper;

    /** Wakes the space if it sleeps; false if it is closed and will not look at its queues any more. */
    boolean wake() {
        int now = phase.get();
        if (now == ASLEEP && phase.compareAndSet(ASLEEP, AWAKE)) {
            LockSupport.unpark(sleeper);
        }
        return now != CLOSED;
    }

    /** Sleeps until it is woken or a timer is due; returns early without harm. */
    void sleep(Dispatcher dispatcher, Clock clock) {
        for (int spin = 0; spin < SPINS; spin++) {
            if (!dispatcher.inbox.isEmpty()) {
                return;
            }
            Thread.onSpinWait();
        }
        if (fallAsleep(dispatcher)) {
            long deadline = dispatcher.timers.nextDeadline();
            if (deadline == Long.MAX_VALUE || !clock.runsByItself()) {
                LockSupport.park(this);
            } else {
                LockSupport.parkNanos(this, deadline - clock.nanos());
            }
        }
        phase.compareAndSet(ASLEEP, AWAKE);
        Thread.interrupted(); // an actor that interrupted its own thread must not keep it from sleeping
    }

    /** Says that the space sleeps, and only then looks again; true if there is still nothing to do, so that it may park. */
    boolean fallAsleep(Dispatcher dispatcher) {
        sleeper = Thread.currentThread();
        phase.set(ASLEEP);
        return dispatcher.isQuiet();
    }

    /** Whether the space has said that it sleeps, and nobody has woken it since. */
    boolean isAsleep() {
        return phase.get() == ASLEEP;
    }

    void close() {
        phase.set(CLOSED);
    }

    boolean isClosed() {
        return phase.get() == CLOSED;
    }
}
