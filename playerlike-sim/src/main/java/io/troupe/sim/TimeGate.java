package io.troupe.sim;

import io.troupe.actor.time.Clock;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/**
 * Whether a simulation's time passes: paused, let go on step by step, or held back by a pacer.
 *
 * <p><b>Threads.</b> Any thread; guarded by the simulation's lock. {@link #awaitTime} and {@link #sleep} belong to the
 * one that ticks.
 */
final class TimeGate {
    private final Object lock;
    private Clock wall = Clock.system();
    private boolean paused;
    private long pausedSinceNanos;
    private long pausedNanos; // of the pauses that are over
    private boolean stoodStill;
    private int stepsWanted;
    private boolean stepping; // paused, and a tick that was let pass has not been followed by another call of awaitTime
    private boolean open = true;

    /** @param lock is notified whenever something changes */
    TimeGate(Object lock) {
        this.lock = lock;
    }

    boolean isPaused() {
        synchronized (lock) {
            return paused;
        }
    }

    void wallClock(Clock clock) {
        synchronized (lock) {
            wall = clock;
        }
    }

    /**
     * A clock that stands still while time is paused, except for a tick that {@link #step} has let pass, which can wait
     * for a silent client as well; what it says has a meaning only as a difference within a tick.
     */
    long runningNanos() {
        synchronized (lock) {
            return (paused && !stepping ? pausedSinceNanos : wall.nanos()) - pausedNanos;
        }
    }

    private void stopClock() {
        pausedSinceNanos = wall.nanos();
    }

    private void letClockRun() {
        pausedNanos += wall.nanos() - pausedSinceNanos;
    }

    /** Whether that changed anything. */
    boolean pause(boolean wanted) {
        synchronized (lock) {
            boolean changes = paused != wanted;
            if (changes && wanted) {
                stopClock();
            } else if (changes && !stepping) {
                letClockRun();
            }
            if (changes) {
                stepping = false;
            }
            paused = wanted;
            stepsWanted = 0;
            lock.notifyAll();
            return changes;
        }
    }

    void step() {
        synchronized (lock) {
            if (!paused) {
                throw new IllegalStateException("only a paused simulation can be stepped");
            }
            stepsWanted++;
            lock.notifyAll();
        }
    }

    /** Nobody waits here any more. */
    void close() {
        synchronized (lock) {
            open = false;
            lock.notifyAll();
        }
    }

    /** Time is standing still for another reason: there is no client. */
    void standsStill() {
        synchronized (lock) {
            stoodStill = true;
        }
    }

    /** Whether time stood still since the last call: nothing is late then. */
    boolean takeStoodStill() {
        synchronized (lock) {
            boolean stood = stoodStill;
            stoodStill = false;
            return stood;
        }
    }

    /**
     * Waits as long as time is paused.
     *
     * @param meanwhile is done again and again
     */
    void awaitTime(@Nullable Runnable meanwhile) {
        endStep();
        while (true) {
            synchronized (lock) {
                if (!paused || !open) {
                    return;
                }
                stoodStill = true;
                if (stepsWanted > 0) {
                    stepsWanted--;
                    stepping = true;
                    letClockRun();
                    return;
                }
                waitMillis(meanwhile == null ? 0 : 1);
            }
            if (meanwhile != null) {
                meanwhile.run();
            }
        }
    }

    private void endStep() {
        synchronized (lock) {
            if (stepping) {
                stepping = false;
                stopClock();
            }
        }
    }

    /** Sleeps at most so long, and no longer if something happens. */
    void sleep(long nanos) {
        synchronized (lock) {
            if (!open) {
                throw new IllegalStateException(Simulation.CLOSED);
            }
            long millis = nanos / 1_000_000;
            if (millis >= 2) {
                waitMillis(millis - 1); // which is good to a millisecond
                return;
            }
        }
        LockSupport.parkNanos(nanos);
        if (Thread.currentThread().isInterrupted()) {
            throw new IllegalStateException("interrupted while waiting for the time");
        }
    }

    private void waitMillis(long millis) {
        try {
            lock.wait(millis);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException("interrupted while waiting for the time", e);
        }
    }
}
