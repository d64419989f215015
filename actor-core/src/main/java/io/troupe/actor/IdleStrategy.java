package io.troupe.actor;

import io.troupe.actor.time.Clock;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/** Padding that keeps the following field off the cache lines of the fields before it. */
@SuppressWarnings("unused")
abstract class IdlePadding {
    private long p00, p01, p02, p03, p04, p05, p06, p07, p08, p09, p10, p11, p12, p13, p14, p15;
}

/** The field that senders read at every message; it is written when the space goes to sleep or is woken. */
abstract class IdlePhase extends IdlePadding {
    volatile int phase;
}

/**
 * The idle strategy of a space: whether it is awake, asleep or closed, and how it is woken.
 *
 * <p><b>Threads.</b> {@link #wake} from any thread, after it has queued an entry; the rest on the space's thread.
 */
@SuppressWarnings("unused")
final class IdleStrategy extends IdlePhase {
    /*
     * No wake-up is lost: the sleeper first publishes that it sleeps and then checks its queues again; the waker first
     * queues an entry and then checks whether the space sleeps. Both are sequentially consistent, so at least one of
     * them sees the other. The waker resets the flag, so that one sleep costs one unpark, however many messages arrive
     * before the thread runs.
     */
    private static final int AWAKE = 0;
    private static final int ASLEEP = 1;
    static final int CLOSED = 2;
    /**
     * The waker could not unpark the space. Unlike {@link #ASLEEP} this does not mean that the space is idle, because
     * it may have continued by itself.
     */
    private static final int NOT_WOKEN = 3;
    /** A waker whose stack overflows within the unpark wakes no thread, so the sleeper does not rely on being woken. */
    static final long LONGEST_SLEEP_NANOS = 1_000_000_000;
    /*
     * Before parking, the space checks its queues a few times, with pauses. A receiver right behind its senders takes
     * each cache line away from them, and both are slower than a receiver that lets a few messages accumulate.
     */
    private static final int LOOKS = 12;
    private static final int SPINS_PER_LOOK = 8;

    private static final VarHandle PHASE;

    private long q00, q01, q02, q03, q04, q05, q06, q07, q08, q09, q10, q11, q12, q13, q14, q15;

    static {
        try {
            PHASE = MethodHandles.lookup().findVarHandle(IdlePhase.class, "phase", int.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private volatile @Nullable Thread sleeper;

    /** Wakes the space if it sleeps; false if it is closed and will not check its queues any more. */
    boolean wake() {
        int now = phase;
        if ((now & ASLEEP) != 0 && PHASE.compareAndSet(this, now, AWAKE)) { // also true for NOT_WOKEN
            try {
                LockSupport.unpark(sleeper);
            } catch (StackOverflowError endOfTheCallersStack) {
                noteNotWoken();
            }
        }
        return now != CLOSED;
    }

    /** Called when the unpark failed: the next caller tries again, or the sleeper wakes up by itself. */
    void noteNotWoken() {
        PHASE.compareAndSet(this, AWAKE, NOT_WOKEN);
    }

    /** Sleeps until it is woken or a timer is due, at most {@value #LONGEST_SLEEP_NANOS} ns; may return early. */
    void sleep(Dispatcher dispatcher, Clock clock) {
        for (int look = 0; look < LOOKS; look++) {
            for (int spin = 0; spin < SPINS_PER_LOOK; spin++) {
                Thread.onSpinWait();
            }
            if (dispatcher.isReady()) {
                return;
            }
        }
        if (fallAsleep(dispatcher)) {
            dispatcher.forgetServed();
            long nanos = clock.runsByItself() ? dispatcher.timers.sleepNanos(LONGEST_SLEEP_NANOS) : LONGEST_SLEEP_NANOS;
            LockSupport.parkNanos(this, nanos);
        }
        if (!PHASE.compareAndSet(this, ASLEEP, AWAKE)) {
            PHASE.compareAndSet(this, NOT_WOKEN, AWAKE);
        }
        Thread.interrupted(); // an actor that interrupted its own thread must not keep it from sleeping
    }

    /**
     * Publishes that the space sleeps, then checks the queues; true if there is still nothing to do, so that it may
     * park.
     */
    boolean fallAsleep(Dispatcher dispatcher) {
        sleeper = Thread.currentThread();
        phase = ASLEEP;
        return dispatcher.isQuiet();
    }

    /** True if the space is asleep and was not woken. */
    boolean isAsleep() {
        return phase == ASLEEP;
    }

    void close() {
        phase = CLOSED;
    }

    boolean isClosed() {
        return phase == CLOSED;
    }
}
