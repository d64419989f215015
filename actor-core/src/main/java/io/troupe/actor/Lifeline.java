package io.troupe.actor;

import io.troupe.actor.time.Clock;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/** Keeps what comes behind it off the cache lines of what comes before. */
@SuppressWarnings("unused")
abstract class LifelinePadding {
    private long p00, p01, p02, p03, p04, p05, p06, p07, p08, p09, p10, p11, p12, p13, p14, p15;
}

/** What senders read at every message, and what is written when the space falls asleep or is woken. */
abstract class LifelinePhase extends LifelinePadding {
    volatile int phase;
}

/**
 * Whether a space is awake, asleep or closed, and how it is woken.
 *
 * <p><b>Threads.</b> {@link #wake} from any thread, after it has queued something; the rest on the space's.
 */
@SuppressWarnings("unused")
final class Lifeline extends LifelinePhase {
    /*
     * No wake-up is lost: the sleeper first says that it sleeps and then looks at its queues again; the waker first
     * queues and then looks whether the other sleeps. Both are sequentially consistent, so at least one of them sees
     * the other. The waker resets the flag itself, so that one sleep costs one unpark, however many messages arrive
     * before the thread really runs.
     */
    private static final int AWAKE = 0;
    private static final int ASLEEP = 1;
    static final int CLOSED = 2;
    /**
     * Its waker could not unpark it; unlike {@link #ASLEEP} it does not say that the space does nothing, for it may
     * have gone on by itself.
     */
    private static final int NOT_WOKEN = 3;
    /** A waker whose stack ends within the unpark wakes nobody: the sleeper does not depend on it. */
    static final long LONGEST_SLEEP_NANOS = 1_000_000_000;
    /*
     * Before it parks it looks a few times, but not without a break: a receiver that is right behind its senders takes
     * each cache line from under their hands, and both are slower than one that lets a few messages gather.
     */
    private static final int LOOKS = 12;
    private static final int SPINS_PER_LOOK = 8;

    private static final VarHandle PHASE;

    private long q00, q01, q02, q03, q04, q05, q06, q07, q08, q09, q10, q11, q12, q13, q14, q15;

    static {
        try {
            PHASE = MethodHandles.lookup().findVarHandle(LifelinePhase.class, "phase", int.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private volatile @Nullable Thread sleeper;

    /** Wakes the space if it sleeps; false if it is closed and will not look at its queues any more. */
    boolean wake() {
        int now = phase;
        if ((now & ASLEEP) != 0 && PHASE.compareAndSet(this, now, AWAKE)) { // NOT_WOKEN, too
            try {
                LockSupport.unpark(sleeper);
            } catch (StackOverflowError endOfTheCallersStack) {
                noteNotWoken();
            }
        }
        return now != CLOSED;
    }

    /** The unpark has failed: the next caller tries again, or the sleeper looks by itself. */
    void noteNotWoken() {
        PHASE.compareAndSet(this, AWAKE, NOT_WOKEN);
    }

    /**
     * Sleeps until it is woken or a timer is due, {@value #LONGEST_SLEEP_NANOS} ns at most; returns early without harm.
     */
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
            long deadline = dispatcher.timers.nextDeadline();
            long nanos = deadline == Long.MAX_VALUE || !clock.runsByItself()
                    ? LONGEST_SLEEP_NANOS
                    : Math.min(LONGEST_SLEEP_NANOS, deadline - clock.nanos());
            LockSupport.parkNanos(this, nanos);
        }
        if (!PHASE.compareAndSet(this, ASLEEP, AWAKE)) {
            PHASE.compareAndSet(this, NOT_WOKEN, AWAKE);
        }
        Thread.interrupted(); // an actor that interrupted its own thread must not keep it from sleeping
    }

    /**
     * Says that the space sleeps, and only then looks again; true if there is still nothing to do, so that it may park.
     */
    boolean fallAsleep(Dispatcher dispatcher) {
        sleeper = Thread.currentThread();
        phase = ASLEEP;
        return dispatcher.isQuiet();
    }

    /** Whether the space has said that it sleeps, and nobody has woken it since. */
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
