package io.troupe.actor;

import io.troupe.actor.internal.loop.CacheLinePadding;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/** The field that senders read at every message; it is written when the space goes to sleep or is woken. */
abstract class IdlePhase extends CacheLinePadding {
    volatile int phase;
}

/** Padding between that field and those that the space's thread writes. */
@SuppressWarnings("unused")
abstract class IdlePhasePadding extends IdlePhase {
    private byte q000, q001, q002, q003, q004, q005, q006, q007, q008, q009, q010, q011, q012, q013, q014, q015;
    private byte q016, q017, q018, q019, q020, q021, q022, q023, q024, q025, q026, q027, q028, q029, q030, q031;
    private byte q032, q033, q034, q035, q036, q037, q038, q039, q040, q041, q042, q043, q044, q045, q046, q047;
    private byte q048, q049, q050, q051, q052, q053, q054, q055, q056, q057, q058, q059, q060, q061, q062, q063;
    private byte q064, q065, q066, q067, q068, q069, q070, q071, q072, q073, q074, q075, q076, q077, q078, q079;
    private byte q080, q081, q082, q083, q084, q085, q086, q087, q088, q089, q090, q091, q092, q093, q094, q095;
    private byte q096, q097, q098, q099, q100, q101, q102, q103, q104, q105, q106, q107, q108, q109, q110, q111;
    private byte q112, q113, q114, q115, q116, q117, q118, q119, q120, q121, q122, q123, q124, q125, q126, q127;
}

/**
 * The idle strategy of a space: whether it is awake, asleep or closed, and how it is woken.
 *
 * <p><b>Threads.</b> {@link #wake} from any thread, after it has queued an entry; the rest on the space's thread.
 */
final class IdleStrategy extends IdlePhasePadding {
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
     * each cache line away from them, and both are slower than a receiver that lets a few messages accumulate. Where
     * these checks find nothing they only delay the sleep, and keep a processor from the thread that will wake the
     * space. So their number falls while they find nothing, and one sleep in PROBE_INTERVAL has all of them.
     */
    static final int MOST_CHECKS = 12;
    private static final int SPINS_PER_CHECK = 8;
    private static final int PROBE_INTERVAL = 64;
    static final int MOST_SPINS = 64; // about 1 us
    static final int ENOUGH = 32; // messages per pass that are worth the transfer of their cache lines
    static final int MANY = 128; // messages per pass of a space that is behind its senders anyway

    private static final VarHandle PHASE;

    static {
        try {
            PHASE = MethodHandles.lookup().findVarHandle(IdlePhase.class, "phase", int.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private volatile @Nullable Thread sleeper;
    private int spins;
    private int checks = MOST_CHECKS; // before the next sleep
    private int sleeps;

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

    /**
     * Waits between two passes, at most about 1 us, if the space is right behind its senders. The wait doubles as long
     * as few messages arrive in it. A space that gets its next message only when it has answered the last one sleeps in
     * between, and waits for one spin only.
     *
     * @param arrivals see {@link Dispatcher#arrivals}
     */
    void letAccumulate(int arrivals) {
        spins = spinsAfter(spins, arrivals);
        for (int spin = 0; spin < spins; spin++) {
            Thread.onSpinWait();
        }
    }

    /** The length of the next wait, from that of the last one and the messages that arrived in it. */
    static int spinsAfter(int spins, int arrivals) {
        if (arrivals == 0 || arrivals > MANY) {
            return 0;
        }
        return arrivals < ENOUGH ? Math.clamp(2L * spins, 1, MOST_SPINS) : spins;
    }

    /** Sleeps until it is woken or a timer is due, at most {@value #LONGEST_SLEEP_NANOS} ns; may return early. */
    void sleep(Dispatcher dispatcher, Clock clock) {
        spins = 0;
        boolean found = findsWork(dispatcher, ++sleeps % PROBE_INTERVAL == 0 ? MOST_CHECKS : checks);
        checks = checksAfter(checks, found);
        if (found) {
            return;
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

    /** Checks the queues so many times, with pauses; true as soon as there is something to do. */
    private static boolean findsWork(Dispatcher dispatcher, int checks) {
        for (int check = 0; check < checks; check++) {
            for (int spin = 0; spin < SPINS_PER_CHECK; spin++) {
                Thread.onSpinWait();
            }
            if (dispatcher.isReady()) {
                return true;
            }
        }
        return false;
    }

    /** The number of checks before the next sleep, from that before this one and whether they found something. */
    static int checksAfter(int checks, boolean found) {
        return found ? MOST_CHECKS : checks / 2;
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
