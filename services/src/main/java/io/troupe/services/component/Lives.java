package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.services.broker.ProviderException;
import io.troupe.services.bus.Address;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The lives of one component, one after the other: which state it is in, and what counts of what it says.
 *
 * <p><b>Threads.</b> The space of its interface, except for the signals of the component.
 */
final class Lives<I, O> {
    /** What the interface does at the turns of a life. */
    interface Turns<O> {
        void begins();

        void runs();

        void ends();

        /** From any thread. */
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
    /** Settled when the life of now is over; made when somebody asks for it. */
    private @Nullable Deferred<@Nullable Void> end;

    /** Settled when the newest invocation or termination is over. */
    private Deferred<@Nullable Void> change = new Deferred<>();

    /** The invocation that waits until no earlier life is being terminated. */
    private @Nullable Deferred<@Nullable Void> next;

    /** How many lives that failed, or ran too late, are being terminated. */
    private int terminations;

    /** Fulfilled when there is none of these any more. */
    private Deferred<@Nullable Void> terminated = new Deferred<>();

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
            case NOT_INVOKED, TERMINATED, FAILED -> terminations == 0 ? begin() : waitForTheLifeBefore();
        };
    }

    private Promise<@Nullable Void> waitForTheLifeBefore() {
        if (next == null) {
            next = new Deferred<>();
        }
        return next;
    }

    private void beginNext() {
        var waiting = next;
        if (waiting != null && terminations == 0) {
            next = null;
            waiting.resolveFrom(begin());
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
            become(Lifecycle.INVOKING);
            turns.begins();
        } catch (RuntimeException | Error refusal) { // a component's code
            fail(refusal);
            return started;
        }
        mine.invoke(new LifeSignals<>(mine, space, owner, observer, turns::output, why -> failed(mine, why)))
                .handle((runs, error) -> {
                    if (mine != life || state != Lifecycle.INVOKING) {
                        late(mine, error);
                    } else if (error != null) {
                        fail(error);
                    } else {
                        become(Lifecycle.RUNNING);
                        started.resolve(null);
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
            bury(past);
        }
    }

    /** Terminates what runs, for good: there is no life after it. */
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
        if (ending == null) {
            if (state == Lifecycle.FAILED) {
                become(Lifecycle.TERMINATED);
            }
            return terminations == 0 ? Promise.done() : terminated;
        }
        if (state == Lifecycle.TERMINATING) {
            return change;
        }
        if (state == Lifecycle.INVOKING) {
            change.reject(new ProviderException(owner + " was terminated while it was being invoked"));
        }
        var stopped = new Deferred<@Nullable Void>();
        change = stopped;
        become(Lifecycle.TERMINATING);
        ending.terminate().handle((ended, error) -> {
            if (error != null) {
                fail(error);
            } else {
                end(Lifecycle.TERMINATED);
                stopped.resolve(null);
            }
            beginNext();
            return null;
        });
        return stopped;
    }

    Promise<@Nullable Void> health() {
        return life == null || state != Lifecycle.RUNNING ? Promise.failed(notRunning()) : life.health();
    }

    /** Settled when what runs now ends: fulfilled if it was terminated, rejected if it has failed. */
    Promise<@Nullable Void> whenEnded() {
        if (life == null) {
            return Promise.failed(notRunning());
        }
        if (end == null) {
            end = new Deferred<>();
        }
        return end;
    }

    /** Why nothing can be had of it now. */
    ProviderException notRunning() {
        return new ProviderException(
                owner + " " + state.words() + (failure == null ? "" : ": " + words(failure)), failure);
    }

    /** What an error says, or what it is if it says nothing. */
    static String words(Throwable error) {
        String message = error.getMessage();
        if (message == null) {
            return error.toString();
        }
        return message.isBlank() ? error.getClass().getName() : message;
    }

    // ---- data

    /** Hands data to the component, if it runs. */
    void data(I input) {
        if (life == null || state != Lifecycle.RUNNING) {
            return; // it failed on the value before
        }
        try {
            life.data(input);
        } catch (RuntimeException | Error thrown) {
            fail(thrown);
        }
    }

    // ---- the end

    private void fail(Throwable why) {
        boolean terminating = state == Lifecycle.TERMINATING;
        Life<I, O> past = life;
        failure = why;
        end(Lifecycle.FAILED);
        if (!change.reject(notRunning())) {
            observer.problem(owner, "has failed", why);
        }
        if (past != null && !terminating) {
            bury(past);
        }
    }

    private void end(Lifecycle last) {
        become(last);
        turns.ends();
        if (life != null) {
            life.end();
            life = null;
        }
        var asked = end;
        end = null;
        if (asked != null && last == Lifecycle.FAILED) {
            asked.reject(notRunning());
        } else if (asked != null) {
            asked.resolve(null);
        }
    }

    private void bury(Life<I, O> past) {
        if (terminations++ == 0) {
            terminated = new Deferred<>();
        }
        past.terminate().handle((ended, error) -> {
            if (error != null) {
                observer.problem(owner, "could not be terminated after it had failed", error);
            }
            if (--terminations == 0) {
                terminated.resolve(null);
                beginNext();
            }
            return null;
        });
    }

    private void become(Lifecycle next) {
        state = next;
        observer.changed(owner, next);
    }

    private void failed(Life<I, O> speaker, Throwable why) {
        if (speaker == life && state != Lifecycle.TERMINATING) {
            fail(why);
        }
    }
}
