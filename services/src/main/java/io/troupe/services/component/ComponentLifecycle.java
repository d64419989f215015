package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.ProviderException;
import io.troupe.broker.internal.Lifecycle;
import io.troupe.bus.Address;
import java.util.Objects;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The lifecycle of one component: a run is one instance of its CCU. Ignores signals from earlier runs.
 *
 * <p><b>Threads.</b> The space of the interface, except for the signals of the component.
 *
 * <p><b>Order.</b> The observer may call the interface; see {@link Lifecycle}.
 *
 * <p><b>Errors.</b> A run whose termination fails is kept. No new run starts beside it; each invocation and each
 * termination terminates it again, until this succeeds.
 */
final class ComponentLifecycle<I, O> extends Lifecycle<ComponentLifecycle<I, O>.Run> {
    /** Callbacks at the transitions of a run. */
    interface Listener<O> {
        void invoking();

        void running();

        void ended();

        /** Called on any thread. */
        void output(O output);
    }

    private final ActorSpace space;
    private final Address owner;
    private final Supplier<? extends ComponentCommunication<I, O>> communication;
    private final ComponentObserver observer;
    private final Listener<O> listener;
    private @Nullable Run latest;
    private @Nullable Throwable failure; // of the latest run

    /** Settled at the end of the current run; null until it is requested. */
    private @Nullable Deferred<@Nullable Void> end;

    private long life; // the number of runs
    private boolean closed;

    ComponentLifecycle(
            ActorSpace space,
            Address owner,
            Supplier<? extends ComponentCommunication<I, O>> communication,
            ComponentObserver observer,
            Listener<O> listener) {
        this.space = space;
        this.owner = owner;
        this.communication = communication;
        this.observer = observer;
        this.listener = listener;
    }

    ComponentState componentState() {
        return stateOf(state());
    }

    private static ComponentState stateOf(State state) {
        return switch (state) {
            case NOT_STARTED -> ComponentState.NOT_INVOKED;
            case STARTING -> ComponentState.INVOKING;
            case RUNNING -> ComponentState.RUNNING;
            case STOPPING -> ComponentState.TERMINATING;
            case STOPPED -> ComponentState.TERMINATED;
            case FAILED -> ComponentState.FAILED;
        };
    }

    // ---- control

    Promise<@Nullable Void> invoke() {
        if (closed) {
            return Promise.failed(new ProviderException(owner + " has left the bus, expected an open interface"));
        }
        return start();
    }

    Promise<@Nullable Void> terminate() {
        rejectPendingStart(new ProviderException(owner + " was terminated while it waited to be invoked"));
        return endRun();
    }

    /**
     * Terminates a life unless a later one has begun: a late message must not end the next life.
     *
     * @param number 0 = the current life, and a start that waits
     */
    Promise<@Nullable Void> terminate(long number) {
        if (number == 0) {
            return terminate();
        }
        return number < life ? Promise.done() : endRun();
    }

    /** The number of the current or last life, counted from 1. */
    long life() {
        return life;
    }

    /** Terminates the current run; no other run starts after it. */
    Promise<@Nullable Void> close() {
        closed = true;
        return terminate();
    }

    /** @param number 0 = the current life */
    Promise<@Nullable Void> health(long number) {
        return number == 0 || number == life
                ? health()
                : Promise.failed(new ProviderException("life " + number + " of " + owner + " has ended, and life "
                        + life + " " + componentState().description()));
    }

    Promise<@Nullable Void> health() {
        Run run = current();
        return run == null || !isRunning(run) ? Promise.failed(notRunning()) : run.health();
    }

    /** Settled when the current run ends: fulfilled if it was terminated, rejected if it has failed. */
    Promise<@Nullable Void> whenEnded() {
        if (current() == null) {
            return Promise.failed(notRunning());
        }
        if (end == null) {
            end = new Deferred<>();
        }
        return end;
    }

    /** The error for requests that need a running component. */
    ProviderException notRunning() {
        return new ProviderException(owner + " " + componentState().description() + reason(failure), failure);
    }

    private static String reason(@Nullable Throwable error) {
        return error == null ? "" : ": " + messageOf(error);
    }

    /** The message of an error, or its class if the message is empty. */
    static String messageOf(Throwable error) {
        String message = error.getMessage();
        if (message == null) {
            return error.toString();
        }
        return message.isBlank() ? error.getClass().getName() : message;
    }

    // ---- the current run

    @Override
    protected Run newRun() {
        failure = null;
        latest = null;
        life++;
        return new Run(communication.get());
    }

    @Override
    protected Throwable interrupted() {
        return new ProviderException(owner + " was terminated while it was being invoked");
    }

    @Override
    protected void prepare(Run run) {
        latest = run;
        listener.invoking();
    }

    @Override
    protected Promise<@Nullable Void> startRun(Run run) {
        return run.invoke();
    }

    @Override
    protected Promise<@Nullable Void> stopRun(Run run) {
        return run.terminate();
    }

    @Override
    protected void startedLate(Run run, @Nullable Throwable error) {
        if (error != null) {
            observer.problem(owner, "failed to be invoked, after it had been given up", error);
        } else {
            observer.info(owner, "ran only after it had been given up, and is terminated again");
            stopAgain(run);
        }
    }

    @Override
    protected void changed(State now, State before) {
        switch (now) {
            case RUNNING -> {
                observer.changed(owner, ComponentState.RUNNING);
                listener.running();
            }
            case STOPPED, FAILED -> ended(now, before);
            case NOT_STARTED, STARTING, STOPPING -> observer.changed(owner, stateOf(now));
        }
    }

    private void ended(State now, State before) {
        boolean wasAwaited = isAwaited();
        Throwable why = failure;
        ProviderException error = now == State.FAILED ? notRunning() : null;
        if (before != State.FAILED) { // else it has ended before
            Deferred<@Nullable Void> ended = end;
            end = null;
            markOver();
            listener.ended();
            if (ended != null) {
                if (error == null) {
                    ended.resolve(null);
                } else {
                    ended.reject(error);
                }
            }
        }
        observer.changed(owner, stateOf(now));
        if (error != null && !wasAwaited) {
            observer.problem(owner, "has failed", Objects.requireNonNull(why));
        }
    }

    private void markOver() {
        if (latest != null) {
            latest.over = true;
        }
    }

    @Override
    protected Throwable failed(@Nullable Run run, State during, Throwable why) {
        failure = why;
        markOver();
        return notRunning();
    }

    @Override
    protected void stopFailed(Throwable why) {
        observer.problem(owner, "could not be terminated after it had failed", why);
    }

    @Override
    protected Throwable blocked(Throwable whyUnstopped) {
        return new ProviderException(
                owner + " cannot be invoked: its life before has not ended" + reason(whyUnstopped), whyUnstopped);
    }

    // ---- data

    /** Passes data to the component if it runs. */
    void data(I input) {
        Run run = current();
        if (run == null || !isRunning(run)) {
            return; // it failed on an earlier value of the same drain
        }
        try {
            run.data(input);
        } catch (RuntimeException | Error thrown) {
            fail(thrown);
        }
    }

    /**
     * One run of the component, from invocation to termination. Calls the component's CCU and converts the exceptions
     * and errors that it throws to rejected promises, except those of {@link #data}.
     */
    final class Run {
        private final ComponentCommunication<I, O> communication;
        private volatile boolean over; // later signals are ignored

        Run(ComponentCommunication<I, O> communication) {
            this.communication = communication;
        }

        Promise<@Nullable Void> invoke() {
            return attempt(() -> communication.invoke(new RunSignals(this)));
        }

        Promise<@Nullable Void> terminate() {
            return attempt(communication::terminate);
        }

        Promise<@Nullable Void> health() {
            return attempt(communication::health);
        }

        void data(I input) {
            communication.data(input);
        }

        private static Promise<@Nullable Void> attempt(Supplier<? extends @Nullable Promise<@Nullable Void>> action) {
            try {
                return Objects.requireNonNull(action.get(), "it returned null, expected a promise");
            } catch (RuntimeException | Error thrown) {
                return Promise.failed(thrown);
            }
        }
    }

    /**
     * Receives the signals of the component during one run, on any thread. Signals after the end of the run are
     * reported to the observer and otherwise ignored.
     */
    private final class RunSignals implements ComponentCommunication.Signals<O> {
        private final Run run;

        RunSignals(Run run) {
            this.run = run;
        }

        @Override
        public void data(O data) {
            if (run.over) {
                observer.info(owner, "gave data after its end: " + data);
                return;
            }
            try {
                listener.output(data);
            } catch (ActorStoppedException closedSpace) {
                observer.info(owner, "gave data after its space had been closed: " + data);
            }
        }

        @Override
        public void failed(Throwable error) {
            try {
                space.execute(() -> {
                    if (run == current() && state() != State.STOPPING) {
                        fail(error);
                    }
                });
            } catch (ActorStoppedException closedSpace) {
                observer.info(owner, "failed after its space had been closed: " + error.getMessage());
            }
        }

        @Override
        public void info(String what) {
            observer.info(owner, what);
        }
    }
}
