package io.troupe.sim;

import io.troupe.actor.Clock;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/**
 * Controls whether simulated time passes: paused, single steps, or delayed by a pacer.
 *
 * <p><b>Threads.</b> Any thread; guarded by the simulation's lock. {@link #awaitUnpaused} and {@link #sleep} belong to
 * the ticking thread.
 */
final class PauseControl {
    private final Object lock;
    private Clock wall = Clock.system();
    private boolean paused;
    private long pausedSinceNanos;
    private long pausedNanos; // total of the pauses that have ended
    private boolean stoodStill;
    private int stepsWanted;
    private boolean stepping; // paused, but during a single step, up to the next call of awaitUnpaused
    private boolean open = true;

    /** @param lock is notified of every change */
    PauseControl(Object lock) {
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
     * A clock that stops while time is paused. It runs during a tick that {@link #step} has let pass, because that tick
     * too can wait for a silent client. Only differences within a tick have a meaning.
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

    /** True if the call changed the state. */
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

    /** Ends all waits. */
    void close() {
        synchronized (lock) {
            open = false;
            lock.notifyAll();
        }
    }

    /** Records that time stands still because there is no client. */
    void standsStill() {
        synchronized (lock) {
            stoodStill = true;
        }
    }

    /** True if time stood still since the last call; a pacer then has no delay to catch up. */
    boolean takeStoodStill() {
        synchronized (lock) {
            boolean stood = stoodStill;
            stoodStill = false;
            return stood;
        }
    }

    /**
     * Waits while time is paused.
     *
     * @param meanwhile repeated while waiting
     */
    void awaitUnpaused(@Nullable Runnable meanwhile) {
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

    /** Sleeps for at most the given time; a change of state ends the sleep. */
    void sleep(long nanos) {
        synchronized (lock) {
            if (!open) {
                throw new IllegalStateException(Simulation.CLOSED);
            }
            long millis = nanos / 1_000_000;
            if (millis >= 2) {
                waitMillis(millis - 1); // Object.wait is accurate to a millisecond
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
