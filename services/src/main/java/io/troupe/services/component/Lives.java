package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.services.broker.ProviderException;
import io.troupe.services.bus.Address;
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
final class Lives<I, O> {
    /** Callbacks at the transitions of a run. */
    interface Turns<O> {
        void begins();

        void runs();

        void ends();

        /** Called on any thread. */
        void output(O output);
    }

    private final ActorSpace space;
    private final Address owner;
    private final Supplier<? extends ComponentCommunication<I, O>> communication;
    private final ComponentObserver observer;
    private final Turns<O> turns;
    private Lifecycle state = Lifecycle.NOT_INVOKED;
    private @Nullable Life<I, O> life;
    private @Nullable Throwable failure;
    /** Settled at the end of the current run; null until it is requested. */
    private @Nullable Deferred<@Nullable Void> end;

    /** Settled when the most recent invocation or termination has completed. */
    private Deferred<@Nullable Void> change = new Deferred<>();

    /** The invocation that waits for the termination of earlier runs, or null. */
    private @Nullable Deferred<@Nullable Void> next;

    /** Runs that are being terminated, or whose termination has failed. */
    private final Set<Life<I, O>> unended = new LinkedHashSet<>();

    /** Number of terminations in progress. */
    private int terminations;

    /** The error of the most recent failed termination, or null. */
    private @Nullable Throwable stuck;

    private boolean closed;

    Lives(
            ActorSpace space,
            Address owner,
            Supplier<? extends ComponentCommunication<I, O>> communication,
            ComponentObserver observer,
            Turns<O> turns) {
        this.space = space;
        this.owner = owner;
        this.communication = communication;
        this.observer = observer;
        this.turns = turns;
    }

    Lifecycle state() {
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
            case TERMINATING -> waitForTheLifeBefore();
            case NOT_INVOKED, TERMINATED, FAILED -> unended.isEmpty() ? begin() : waitForTheLifeBefore();
        };
    }

    private Promise<@Nullable Void> waitForTheLifeBefore() {
        if (next == null) {
            next = new Deferred<>();
        }
        Deferred<@Nullable Void> waiting = next;
        terminateUnended();
        return waiting;
    }

    private void beginNext() {
        Deferred<@Nullable Void> waiting = next;
        if (waiting == null) {
            return;
        }
        next = null;
        if (unended.isEmpty()) {
            waiting.resolveFrom(invoke());
        } else {
            waiting.reject(new ProviderException(
                    owner + " cannot be invoked: its life before has not ended" + why(stuck), stuck));
        }
    }

    private Promise<@Nullable Void> begin() {
        failure = null;
        var started = new Deferred<@Nullable Void>();
        change = started;
        Life<I, O> mine;
        try {
            mine = new Life<>(communication.get());
            life = mine;
            state = Lifecycle.INVOKING;
            turns.begins();
        } catch (RuntimeException | Error refusal) { // thrown by code of the component
            fail(refusal);
            return started;
        }
        observer.changed(owner, Lifecycle.INVOKING);
        if (mine != life || state != Lifecycle.INVOKING) {
            return started; // terminated by the observer
        }
        mine.invoke(new LifeSignals<>(mine, space, owner, observer, turns::output, why -> failed(mine, why)))
                .handle((runs, error) -> {
                    if (mine != life || state != Lifecycle.INVOKING) {
                        late(mine, error);
                    } else if (error != null) {
                        fail(error);
                    } else {
                        state = Lifecycle.RUNNING;
                        started.resolve(null);
                        observer.changed(owner, Lifecycle.RUNNING);
                        turns.runs();
                    }
                    return null;
                });
        return started;
    }

    private void late(Life<I, O> past, @Nullable Throwable error) {
        if (error != null) {
            observer.problem(owner, "failed to be invoked, after it had been given up", error);
        } else {
            observer.told(owner, "ran only after it had been given up, and is terminated again");
            terminate(past);
        }
    }

    /** Terminates the current run; no other run starts after it. */
    Promise<@Nullable Void> close() {
        closed = true;
        return terminate();
    }

    Promise<@Nullable Void> terminate() {
        if (next != null) {
            var given = next;
            next = null;
            given.reject(new ProviderException(owner + " was terminated while it waited to be invoked"));
        }
        Life<I, O> ending = life;
        if (state == Lifecycle.TERMINATING) {
            return change;
        }
        if (ending == null && unended.isEmpty()) {
            if (state == Lifecycle.FAILED) {
                state = Lifecycle.TERMINATED;
                observer.changed(owner, Lifecycle.TERMINATED);
            }
            return Promise.done();
        }
        var stopped = new Deferred<@Nullable Void>();
        Deferred<@Nullable Void> given = change;
        boolean invoking = state == Lifecycle.INVOKING;
        change = stopped;
        state = Lifecycle.TERMINATING;
        if (invoking) {
            given.reject(new ProviderException(owner + " was terminated while it was being invoked"));
        }
        observer.changed(owner, Lifecycle.TERMINATING);
        terminateUnended();
        if (ending != null) {
            terminate(ending);
        }
        return stopped;
    }

    Promise<@Nullable Void> health() {
        return life == null || state != Lifecycle.RUNNING ? Promise.failed(notRunning()) : life.health();
    }

    /** Settled when the current run ends: fulfilled if it was terminated, rejected if it has failed. */
    Promise<@Nullable Void> whenEnded() {
        if (life == null) {
            return Promise.failed(notRunning());
        }
        if (end == null) {
            end = new Deferred<>();
        }
        return end;
    }

    /** The error for requests that need a running component. */
    ProviderException notRunning() {
        return new ProviderException(owner + " " + state.words() + why(failure), failure);
    }

    private static String why(@Nullable Throwable error) {
        return error == null ? "" : ": " + words(error);
    }

    /** The message of an error, or its class if the message is empty. */
    static String words(Throwable error) {
        String message = error.getMessage();
        if (message == null) {
            return error.toString();
        }
        return message.isBlank() ? error.getClass().getName() : message;
    }

    // ---- data

    /** Passes data to the component if it runs. */
    void data(I input) {
        if (life == null || state != Lifecycle.RUNNING) {
            return; // it failed on an earlier value of the same drain
        }
        try {
            life.data(input);
        } catch (RuntimeException | Error thrown) {
            fail(thrown);
        }
    }

    // ---- the end

    private void fail(Throwable why) {
        failure = why;
        end(Lifecycle.FAILED);
    }

    private void end(Lifecycle last) {
        boolean terminating = state == Lifecycle.TERMINATING;
        Life<I, O> past = life;
        Deferred<@Nullable Void> asked = end;
        Deferred<@Nullable Void> changed = change;
        state = last;
        life = null;
        end = null;
        ProviderException why = last == Lifecycle.FAILED ? notRunning() : null;
        if (past != null) {
            past.end();
            if (!terminating) {
                terminate(past);
            }
        }
        turns.ends();
        if (asked != null) {
            settle(asked, why);
        }
        boolean wasAwaited = settle(changed, why);
        observer.changed(owner, last);
        if (why != null && !wasAwaited) {
            observer.problem(owner, "has failed", why.getCause());
        }
    }

    private static boolean settle(Deferred<@Nullable Void> promise, @Nullable Throwable error) {
        return error == null ? promise.resolve(null) : promise.reject(error);
    }

    private void terminate(Life<I, O> past) {
        unended.add(past);
        terminations++;
        past.terminate().handle((ended, error) -> {
            if (error == null) {
                unended.remove(past);
            } else {
                unended.add(past);
                stuck = error;
                if (past != life) {
                    observer.problem(owner, "could not be terminated after it had failed", error);
                }
            }
            if (--terminations == 0) {
                terminationsAnswered();
            }
            return null;
        });
    }

    private void terminateUnended() {
        if (terminations == 0) {
            List.copyOf(unended).forEach(this::terminate);
        }
    }

    private void terminationsAnswered() {
        if (state == Lifecycle.TERMINATING && unended.isEmpty()) {
            end(Lifecycle.TERMINATED);
        } else if (state == Lifecycle.TERMINATING) {
            fail(Objects.requireNonNull(stuck));
        }
        beginNext();
    }

    private void failed(Life<I, O> speaker, Throwable why) {
        if (speaker == life && state != Lifecycle.TERMINATING) {
            fail(why);
        }
    }
}
