package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Address;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * State machine of one component: starts, terminates and restarts it, and ignores signals from earlier runs.
 *
 * <p><b>Threads.</b> The space of the interface, except for the signals of the component.
 *
 * <p><b>Order.</b> The observer may call the interface. It is therefore notified after the fields have been updated,
 * and the fields are read again after each notification.
 *
 * <p><b>Errors.</b> A run whose termination fails is kept. No new run starts beside it; each invocation and each
 * termination terminates it again, until this succeeds.
 */
final class ComponentLifecycle<I, O> {
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
    private ComponentState state = ComponentState.NOT_INVOKED;
    private @Nullable Run current;
    private @Nullable Throwable failure;
    /** Settled at the end of the current run; null until it is requested. */
    private @Nullable Deferred<@Nullable Void> end;

    /** Settled when the most recent invocation or termination has completed. */
    private Deferred<@Nullable Void> change = new Deferred<>();

    /** The invocation that waits for the termination of earlier runs, or null. */
    private @Nullable Deferred<@Nullable Void> pendingInvocation;

    /** Runs that are being terminated, or whose termination has failed. */
    private final Set<Run> unterminated = new LinkedHashSet<>();

    /** Number of terminations in progress. */
    private int terminations;

    /** The error of the most recent failed termination, or null. */
    private @Nullable Throwable terminationError;

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

    ComponentState state() {
        return state;
    }

    // ---- control

    Promise<@Nullable Void> invoke() {
        if (closed) {
            return Promise.failed(new ProviderException(owner + " has left the bus, expected an open interface"));
        }
        return switch (state) {
            case RUNNING -> Promise.done();
            case INVOKING -> change;
            case TERMINATING -> invokeAfterTermination();
            case NOT_INVOKED, TERMINATED, FAILED -> unterminated.isEmpty() ? startRun() : invokeAfterTermination();
        };
    }

    private Promise<@Nullable Void> invokeAfterTermination() {
        if (pendingInvocation == null) {
            pendingInvocation = new Deferred<>();
        }
        Deferred<@Nullable Void> invocation = pendingInvocation;
        terminateUnterminated();
        return invocation;
    }

    private void invokePending() {
        Deferred<@Nullable Void> invocation = pendingInvocation;
        if (invocation == null) {
            return;
        }
        pendingInvocation = null;
        if (unterminated.isEmpty()) {
            invocation.resolveFrom(invoke());
        } else {
            invocation.reject(new ProviderException(
                    owner + " cannot be invoked: its life before has not ended" + reason(terminationError),
                    terminationError));
        }
    }

    private Promise<@Nullable Void> startRun() {
        failure = null;
        var started = new Deferred<@Nullable Void>();
        change = started;
        Run run;
        try {
            run = new Run(communication.get());
            current = run;
            state = ComponentState.INVOKING;
            listener.invoking();
        } catch (RuntimeException | Error refusal) { // thrown by code of the component
            fail(refusal);
            return started;
        }
        observer.changed(owner, ComponentState.INVOKING);
        if (run != current || state != ComponentState.INVOKING) {
            return started; // terminated by the observer
        }
        run.invoke().handle((invoked, error) -> {
            if (run != current || state != ComponentState.INVOKING) {
                completedLate(run, error);
            } else if (error != null) {
                fail(error);
            } else {
                state = ComponentState.RUNNING;
                started.resolve(null);
                observer.changed(owner, ComponentState.RUNNING);
                listener.running();
            }
            return null;
        });
        return started;
    }

    private void completedLate(Run run, @Nullable Throwable error) {
        if (error != null) {
            observer.problem(owner, "failed to be invoked, after it had been given up", error);
        } else {
            observer.info(owner, "ran only after it had been given up, and is terminated again");
            terminate(run);
        }
    }

    /** Terminates the current run; no other run starts after it. */
    Promise<@Nullable Void> close() {
        closed = true;
        return terminate();
    }

    Promise<@Nullable Void> terminate() {
        if (pendingInvocation != null) {
            var invocation = pendingInvocation;
            pendingInvocation = null;
            invocation.reject(new ProviderException(owner + " was terminated while it waited to be invoked"));
        }
        Run ending = current;
        if (state == ComponentState.TERMINATING) {
            return change;
        }
        if (ending == null && unterminated.isEmpty()) {
            if (state == ComponentState.FAILED) {
                state = ComponentState.TERMINATED;
                observer.changed(owner, ComponentState.TERMINATED);
            }
            return Promise.done();
        }
        var stopped = new Deferred<@Nullable Void>();
        Deferred<@Nullable Void> invocation = change;
        boolean invoking = state == ComponentState.INVOKING;
        change = stopped;
        state = ComponentState.TERMINATING;
        if (invoking) {
            invocation.reject(new ProviderException(owner + " was terminated while it was being invoked"));
        }
        observer.changed(owner, ComponentState.TERMINATING);
        terminateUnterminated();
        if (ending != null) {
            terminate(ending);
        }
        return stopped;
    }

    Promise<@Nullable Void> health() {
        return current == null || state != ComponentState.RUNNING ? Promise.failed(notRunning()) : current.health();
    }

    /** Settled when the current run ends: fulfilled if it was terminated, rejected if it has failed. */
    Promise<@Nullable Void> whenEnded() {
        if (current == null) {
            return Promise.failed(notRunning());
        }
        if (end == null) {
            end = new Deferred<>();
        }
        return end;
    }

    /** The error for requests that need a running component. */
    ProviderException notRunning() {
        return new ProviderException(owner + " " + state.description() + reason(failure), failure);
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

    // ---- data

    /** Passes data to the component if it runs. */
    void data(I input) {
        if (current == null || state != ComponentState.RUNNING) {
            return; // it failed on an earlier value of the same drain
        }
        try {
            current.data(input);
        } catch (RuntimeException | Error thrown) {
            fail(thrown);
        }
    }

    // ---- the end of a run

    private void fail(Throwable error) {
        failure = error;
        end(ComponentState.FAILED);
    }

    private void end(ComponentState last) {
        boolean terminating = state == ComponentState.TERMINATING;
        Run run = current;
        Deferred<@Nullable Void> runEnd = end;
        Deferred<@Nullable Void> pendingChange = change;
        state = last;
        current = null;
        end = null;
        ProviderException error = last == ComponentState.FAILED ? notRunning() : null;
        if (run != null) {
            run.over = true;
            if (!terminating) {
                terminate(run);
            }
        }
        listener.ended();
        if (runEnd != null) {
            settle(runEnd, error);
        }
        boolean wasAwaited = settle(pendingChange, error);
        observer.changed(owner, last);
        if (error != null && !wasAwaited) {
            observer.problem(owner, "has failed", error.getCause());
        }
    }

    private static boolean settle(Deferred<@Nullable Void> promise, @Nullable Throwable error) {
        return error == null ? promise.resolve(null) : promise.reject(error);
    }

    private void terminate(Run run) {
        unterminated.add(run);
        terminations++;
        run.terminate().handle((ended, error) -> {
            if (error == null) {
                unterminated.remove(run);
            } else {
                unterminated.add(run);
                terminationError = error;
                if (run != current) {
                    observer.problem(owner, "could not be terminated after it had failed", error);
                }
            }
            if (--terminations == 0) {
                terminationsCompleted();
            }
            return null;
        });
    }

    private void terminateUnterminated() {
        if (terminations == 0) {
            List.copyOf(unterminated).forEach(this::terminate);
        }
    }

    private void terminationsCompleted() {
        if (state == ComponentState.TERMINATING && unterminated.isEmpty()) {
            end(ComponentState.TERMINATED);
        } else if (state == ComponentState.TERMINATING) {
            fail(Objects.requireNonNull(terminationError));
        }
        invokePending();
    }

    /**
     * One run of the component, from invocation to termination. Calls the component's CCU and converts the exceptions
     * and errors that it throws to rejected promises, except those of {@link #data}.
     */
    private final class Run {
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
                return Objects.requireNonNull(action.get(), "it answered null, expected a promise");
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
                    if (run == current && state != ComponentState.TERMINATING) {
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
