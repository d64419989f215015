package io.troupe.actor;

import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * A call that answers, on its way, and at once the promise of the answer. For generated code: each method of an actor type that returns a
 * promise has its subclass, whose fields are the arguments.
 */
public abstract class Request<T extends @Nullable Object> extends Promise<T> {
    private final ActorCell cell;
    private boolean askedInside;

    protected Request(ActorCell cell) {
        this.cell = cell;
    }

    /** Calls the method. */
    protected abstract @Nullable Promise<? extends T> invoke(Object implementation) throws Throwable;

    /** The method's name and parameter types. */
    protected abstract String method();

    /** The arguments, for messages about this request. */
    protected abstract Object[] arguments();

    @Override
    protected final void run() throws Throwable {
        cell.deliver(this);
    }

    /** What an actor throws is its answer. */
    @Override
    protected final void threw(Throwable thrown) {
        reject(thrown);
        Reports.rethrowIfFatal(thrown);
    }

    @Override
    protected final boolean isMail() {
        return true;
    }

    @Override
    protected final Home home() {
        return cell.space();
    }

    final void noteAsker(boolean inside) {
        askedInside = inside;
    }

    @Override
    protected final boolean isLocal() {
        return askedInside;
    }

    @Override
    protected final boolean madeOutside() {
        return !askedInside;
    }

    @Override
    protected final String progress() {
        return isDone() ? "" : cell.space().progressOf(this);
    }

    /** Calls the method and passes its outcome on. */
    final void answer(Object implementation) throws Throwable {
        Promise<? extends T> answer = invoke(implementation);
        if (answer == null) {
            reject(new ActorException(method() + " of " + cell + " answered null, expected a promise"));
        } else {
            followAtHome(answer);
        }
    }

    final void reject(Throwable error) {
        settleError(error);
    }

    @Override
    public final String toString() {
        return Message.describe(method(), arguments()) + " of " + cell;
    }
}
