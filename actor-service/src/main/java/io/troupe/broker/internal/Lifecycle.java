package io.troupe.broker.internal;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * The state machine "start, run, fail, stop": one current run, and no run begins before the earlier ones have been
 * stopped. Users meet it as the health of a provider and as the state of a component.
 *
 * <p><b>Role.</b> The broker has one for each registered provider, a component's interface has one for its component.
 * This class keeps the books: which run is the current one, which earlier runs may still run, and which callers wait.
 * The subclass starts and stops a run, and reports what happens.
 *
 * <p><b>Threads.</b> One actor space.
 *
 * <p><b>Order.</b> The methods of the subclass may call {@link #start} and {@link #endRun}. They are therefore called
 * after the fields have been updated, and the fields are read again after each of them. A start during a start shares
 * it. A start during a stop waits for it. A run that fails is stopped, because a part of it may still run. A run that
 * started too late is given to {@link #startedLate}, which has it stopped again.
 *
 * @param <R> one run, from start to stop
 */
public abstract class Lifecycle<R> {
    /** The state of what is started and stopped. */
    public enum State {
        NOT_STARTED,
        STARTING,
        RUNNING,
        STOPPING,
        STOPPED,
        /** The current run could not be started, has failed, or could not be stopped. */
        FAILED
    }

    private State state = State.NOT_STARTED;
    private @Nullable R current;

    /** Settled when the most recent start or stop has completed. */
    private Deferred<@Nullable Void> change = new Deferred<>();

    /** The start that waits for the end of earlier runs, or null. */
    private @Nullable Deferred<@Nullable Void> pendingStart;

    /** Runs that have to be stopped before the next one begins: those being stopped, and those whose stop failed. */
    private final Set<R> unstopped = new LinkedHashSet<>();

    /** The number of stops in progress, and what is fulfilled when there is none any more. */
    private int stops;

    private @Nullable Deferred<@Nullable Void> allStopped;

    /** The error of the most recent stop that failed, or null. */
    private @Nullable Throwable stopError;

    // ---- what the subclass adds

    /** Creates the next run. If this throws, the run has failed. */
    protected abstract R newRun();

    /** Prepares a run that has just become the current one. If this throws, the run has failed. */
    protected void prepare(R run) {}

    /** Starts the run; fulfilled when it runs. */
    protected abstract Promise<@Nullable Void> startRun(R run);

    /** Stops the run; fulfilled when no part of it runs any more. May be called again. */
    protected abstract Promise<@Nullable Void> stopRun(R run);

    /**
     * The start of a run has completed after the run had ended.
     *
     * @param error null if the run runs now: use {@link #stopAgain}
     */
    protected abstract void startedLate(R run, @Nullable Throwable error);

    /** The state has changed; callers that wait for the change are notified after that. */
    protected abstract void changed(State now, State before);

    /**
     * The current run has failed. Called before it is stopped.
     *
     * @param run null if it could not be created
     * @param during STARTING, RUNNING, or STOPPING if the stop failed
     * @return the error for callers that wait
     */
    protected abstract Throwable failed(@Nullable R run, State during, Throwable why);

    /** Returns whether a part of a run that failed with this error may still run, so that it has to be stopped. */
    protected boolean mayStillRun(Throwable why) {
        return true;
    }

    /** The stop of an earlier run has failed. */
    protected abstract void stopFailed(Throwable why);

    /** What has to end elsewhere before a run may begin; null if nothing has to. */
    protected @Nullable Promise<?> waitsFor() {
        return null;
    }

    /** Returns the error for a start that must not begin now, or null. */
    protected @Nullable Throwable refusal() {
        return null;
    }

    /**
     * Earlier runs could not be stopped. Returns the error for a start that waits for them, or null if they are given
     * up: then the next run may begin beside them.
     */
    protected abstract @Nullable Throwable blocked(Throwable whyUnstopped);

    /** Returns the error for callers that wait for a start which a stop interrupts. */
    protected abstract Throwable interrupted();

    // ---- state

    public final State state() {
        return state;
    }

    /** The run from the beginning of its start to the end of its stop, or its failure. */
    protected final @Nullable R current() {
        return current;
    }

    /** Returns whether the run is the current one and runs. */
    protected final boolean isRunning(R run) {
        return run == current && state == State.RUNNING;
    }

    /** A start or a stop in progress, also a start that waits; null if there is none. */
    protected final @Nullable Promise<@Nullable Void> inProgress() {
        if (pendingStart != null) {
            return pendingStart;
        }
        return state == State.STARTING || state == State.STOPPING ? change : allStopped;
    }

    /** Returns whether a caller waits for the start or stop that has just ended in this state. */
    protected final boolean isAwaited() {
        return !change.isDone();
    }

    /** Returns whether a start is in progress or waits. */
    protected final boolean isStarting() {
        return pendingStart != null || state == State.STARTING;
    }

    /** Returns whether the stop of a run is in progress. */
    protected final boolean isStopping() {
        return stops > 0;
    }

    // ---- start

    /** Starts a run unless one runs or is being started. */
    public Promise<@Nullable Void> start() {
        if (state == State.RUNNING) {
            return Promise.done();
        }
        if (isStarting()) {
            return Objects.requireNonNull(inProgress());
        }
        var start = new Deferred<@Nullable Void>();
        pendingStart = start;
        startPending();
        return start;
    }

    /** Rejects a start that waits for the end of earlier runs. */
    protected final void rejectPendingStart(Throwable why) {
        Deferred<@Nullable Void> start = pendingStart;
        if (start != null) {
            pendingStart = null;
            start.reject(why);
        }
    }

    private void startPending() {
        Deferred<@Nullable Void> start = pendingStart;
        if (start == null) {
            return;
        }
        Promise<?> others = waitsFor(); // also during a stop: the others are stopped at once
        if (stops > 0) {
            return; // called again when the last stop has completed
        }
        if (others != null) {
            others.handle((ended, error) -> {
                if (start == pendingStart) {
                    startPending();
                }
                return null;
            });
        } else if (unstopped.isEmpty()) {
            begin(start);
        } else {
            stopUnstopped();
        }
    }

    private void begin(Deferred<@Nullable Void> start) {
        pendingStart = null;
        Throwable refusal = refusal();
        if (refusal != null) {
            start.reject(refusal);
            return;
        }
        State before = state;
        change = start;
        state = State.STARTING;
        R run;
        try {
            run = newRun();
            current = run;
            prepare(run);
        } catch (RuntimeException | Error thrown) {
            fail(thrown);
            return;
        }
        changed(State.STARTING, before);
        if (run != current || state != State.STARTING) {
            return; // stopped by changed()
        }
        startRun(run).handle((started, error) -> {
            if (run != current || state != State.STARTING) {
                startedLate(run, error);
            } else if (error != null) {
                fail(error);
            } else {
                state = State.RUNNING;
                start.resolve(null); // first: a run that fails in changed() has started all the same
                changed(State.RUNNING, State.STARTING);
            }
            return null;
        });
    }

    // ---- failure and stop

    /** The current run has failed: stops it. */
    protected final void fail(Throwable why) {
        R run = current;
        State during = state;
        Deferred<@Nullable Void> waiting = change;
        current = null;
        state = State.FAILED;
        Throwable error = failed(run, during, why);
        if (run != null && during != State.STOPPING && mayStillRun(why)) {
            stopAgain(run);
        }
        changed(State.FAILED, during);
        waiting.reject(error);
    }

    /** Ends the current run, and stops earlier runs again whose stop has failed. */
    protected final Promise<@Nullable Void> endRun() {
        if (state == State.STOPPING) {
            return change;
        }
        State before = state;
        R ending = current;
        if (ending == null && unstopped.isEmpty()) {
            if (before == State.FAILED) {
                state = State.STOPPED;
                changed(State.STOPPED, before);
            }
            return Promise.done();
        }
        var stopped = new Deferred<@Nullable Void>();
        Deferred<@Nullable Void> start = change;
        change = stopped;
        state = State.STOPPING;
        if (before == State.STARTING) {
            start.reject(interrupted());
        }
        changed(State.STOPPING, before);
        stopUnstopped();
        if (ending != null) {
            stopAgain(ending);
        }
        return stopped;
    }

    /** An earlier run may still run: it has to be stopped before the next one begins. */
    protected final void mustStop(R run) {
        unstopped.add(run);
    }

    private void stopUnstopped() {
        if (stops == 0) {
            List.copyOf(unstopped).forEach(this::stopAgain);
        }
    }

    /** Stops a run; also one that is being stopped already. */
    protected final void stopAgain(R run) {
        unstopped.add(run);
        if (stops++ == 0) {
            allStopped = new Deferred<>();
        }
        stopRun(run).handle((stopped, error) -> {
            if (error == null) {
                unstopped.remove(run);
            } else {
                unstopped.add(run);
                stopError = error;
                if (run != current) {
                    stopFailed(error);
                }
            }
            if (--stops == 0) {
                stopsCompleted();
            }
            return null;
        });
    }

    private void stopsCompleted() {
        Deferred<@Nullable Void> all = Objects.requireNonNull(allStopped);
        allStopped = null;
        Throwable whyUnstopped = unstopped.isEmpty() ? null : stopError;
        if (state == State.STOPPING && whyUnstopped != null) {
            fail(whyUnstopped);
        } else if (state == State.STOPPING) {
            stopped();
        }
        if (whyUnstopped != null) {
            Throwable blocked = blocked(whyUnstopped);
            if (blocked == null) {
                unstopped.clear();
            } else {
                rejectPendingStart(blocked);
            }
        }
        startPending();
        all.resolve(null);
    }

    private void stopped() {
        Deferred<@Nullable Void> waiting = change;
        current = null;
        state = State.STOPPED;
        changed(State.STOPPED, State.STOPPING);
        waiting.resolve(null);
    }
}
