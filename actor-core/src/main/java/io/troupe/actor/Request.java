package io.troupe.actor;

import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * A message that returns a result; also the promise of that result. For generated code: each method of an actor type
 * that returns a promise has a subclass whose fields are the arguments.
 *
 * @hidden
 */
public abstract class Request<T extends @Nullable Object> extends Promise<T> {
    private static final int COUNTED = 1_000; // bounds the cost of a time-out behind a long queue

    private final ActorCell cell;
    private boolean calledInside;

    protected Request(ActorCell cell) {
        this.cell = cell;
    }

    /** Calls the method. */
    protected abstract @Nullable Promise<? extends T> invoke(Object implementation) throws Throwable;

    /** The method's name and parameter types. */
    protected abstract String method();

    /** The arguments, for log and error messages. */
    protected abstract Object[] arguments();

    /** Repeated in each generated class, to keep its call site of {@code invoke} monomorphic. */
    @Override
    protected @Nullable Node serve() throws Throwable {
        Object target = target();
        return target == null ? null : answer(invoke(target));
    }

    @Override
    protected final void run() throws Throwable {
        enqueue(serve());
    }

    private void enqueue(@Nullable Node callback) {
        if (callback != null) {
            cell.space().enqueueCallback(callback);
        }
    }

    /** The target to invoke, or null if the request was already handled or rejected. */
    protected final @Nullable Object target() {
        return cell.target(this);
    }

    /** An exception of the actor rejects the promise; an error of the virtual machine is reported in addition. */
    @Override
    protected final void threw(Throwable thrown) {
        reject(thrown);
        if (thrown instanceof VirtualMachineError
                && !(thrown instanceof StackOverflowError)
                && !(thrown instanceof OutOfMemoryError)) {
            cell.space().reports().error(method() + " of", cell, thrown, null);
        }
    }

    @Override
    protected final boolean isMessage() {
        return true;
    }

    @Override
    protected final Home home() {
        return cell.space();
    }

    final ActorCell receiver() {
        return cell;
    }

    final void noteCaller(boolean inside) {
        calledInside = inside;
    }

    @Override
    protected final boolean isLocal() {
        return calledInside;
    }

    @Override
    protected final boolean madeOutside() {
        return !calledInside;
    }

    @Override
    protected final String progress() {
        ActorSpace space = cell.space();
        if (isDone() || !space.isCurrent()) {
            return "";
        }
        int inMailbox = cell.placeInMailbox(this, COUNTED);
        int before = inMailbox >= 0 ? inMailbox : space.dispatcher.messagesBefore(this, COUNTED);
        if (before >= 0) {
            return ", which has not begun it: " + before + " calls come first";
        }
        return space.dispatcher.isLongerThan(COUNTED)
                ? ", where more than " + COUNTED + " calls wait"
                : ", which has begun it";
    }

    /**
     * Settles this request with the outcome of the promise that the method returned.
     *
     * @return the listener that must be run next and is in no queue, or null
     */
    protected final @Nullable Node answer(@Nullable Promise<? extends T> answer) {
        if (answer == null) {
            reject(new ActorException(method() + " of " + cell + " answered null, expected a promise"));
            return null;
        }
        return followAtHome(answer);
    }

    /** Like {@link #serve}, for a target that has already been looked up. */
    final void serveWith(Object target) throws Throwable {
        enqueue(answer(invoke(target)));
    }

    /**
     * Follows a promise that is still pending: if the instance that began this request ends first, this request is
     * rejected. The request of another call is an exception: its actor settles it, or the end of that actor does.
     */
    @Override
    protected final void followPending(Promise<? extends T> answer) {
        if (answer instanceof Request<?>) {
            follow(answer);
        } else {
            follow(answer, cell.life());
        }
    }

    /** Rejects this request; false if it was already settled. */
    final boolean reject(Throwable error) {
        return settleError(error);
    }

    @Override
    public final String toString() {
        return Message.describe(method(), arguments()) + " of " + cell;
    }
}
