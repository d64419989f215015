package io.troupe.actor;

import io.troupe.actor.internal.Forwarder;
import io.troupe.actor.internal.Recipient;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.concurrent.CancellationException;
import org.jspecify.annotations.Nullable;

/**
 * A message that returns a result; also the promise of that result. For generated code: each method of an actor type
 * that returns a promise has a subclass whose fields are the arguments. Public only for these.
 *
 * @hidden
 */
@SuppressWarnings("exports") // of what it is made is for this library
public abstract class Request<T extends @Nullable Object> extends Promise<T> {
    private final Recipient receiver;
    private boolean calledInside;
    private volatile boolean timedOut; // a time limit on this promise has passed, perhaps not that of every listener

    protected Request(Recipient receiver) {
        this.receiver = receiver;
    }

    /** Calls the method. */
    protected abstract @Nullable Promise<? extends T> invoke(Object implementation) throws Throwable;

    /** The method's name and parameter types. */
    public abstract String method();

    /** The arguments, for log and error messages. */
    public abstract Object[] arguments();

    public final Recipient receiver() {
        return receiver;
    }

    /** Repeated in each generated class, to keep its call site of {@code invoke} monomorphic. */
    @Override
    protected @Nullable QueueEntry serve() throws Throwable {
        Object target = target();
        return target == null ? null : answer(invoke(target));
    }

    /** Like {@link #serve}, for a target that has already been looked up; queues the listener. */
    public final void serveWith(Object target) throws Throwable {
        QueueEntry callback = answer(invoke(target));
        if (callback != null) {
            receiver.home().enqueue(callback);
        }
    }

    /** Like {@link #serveWith}, for an actor that passes its calls on. */
    @SuppressWarnings("unchecked") // the forwarder returns the outcome of the same method
    public final void serveBy(Forwarder forwarder) {
        QueueEntry callback = answer((Promise<? extends T>) forwarder.forward(this));
        if (callback != null) {
            receiver.home().enqueue(callback);
        }
    }

    /** Sends the same request to another actor of a type that has this method. */
    public @Nullable Promise<? extends T> sendTo(Object proxy) throws Throwable {
        return invoke(proxy);
    }

    /** True if it is settled, or each of its listeners was cancelled or has reached its time limit. */
    public final boolean isAbandoned() {
        return isDone() || isGivenUp();
    }

    /** The target to invoke, or null if the request was already handled or rejected. */
    protected final @Nullable Object target() {
        return receiver.target(this);
    }

    /**
     * An exception of the actor rejects the promise; an error of the virtual machine is reported in addition, and
     * supervision may count it as a failure of the actor.
     */
    @Override
    protected final void threw(Throwable thrown) {
        reject(thrown);
        receiver.requestFailed(this, thrown, isVirtualMachineError(thrown));
    }

    @Override
    protected final boolean isMessage() {
        return true;
    }

    @Override
    protected final TurnOwner turnOwner() {
        return receiver().life();
    }

    @Override
    final Home home() {
        return receiver.home();
    }

    @Override
    void cancelled() {
        receiver.cancelled(this);
    }

    @Override
    final void timedOut() {
        timedOut = true;
        receiver.timedOut(this);
    }

    /** True if this request may have been given up: {@link #dropIfAbandoned} decides. */
    @Override
    final boolean mayBeGivenUp() {
        return timedOut;
    }

    /**
     * Rejects this request, which has not begun, if the time limits of all its listeners have passed; false if it is to
     * begin. On the space's thread.
     */
    public final boolean dropIfAbandoned() {
        return timedOut
                && isGivenUp()
                && (isDone()
                        || reject(new CancellationException(name() + " was not begun: its callers had timed out")));
    }

    public final void noteCaller(boolean inside) {
        calledInside = inside;
    }

    @Override
    final boolean isLocal() {
        return calledInside;
    }

    @Override
    final boolean madeOutside() {
        return !calledInside;
    }

    @Override
    final String progress() {
        return isDone() || !home().isCurrent() ? "" : receiver.progressOf(this);
    }

    /** See {@link #progress}. */
    public final String progressNow() {
        return progress();
    }

    /**
     * Settles this request with the outcome of the promise that the method returned.
     *
     * @return the listener that must be run next and is in no queue, or null
     */
    protected final @Nullable QueueEntry answer(@Nullable Promise<? extends T> answer) {
        if (answer == null) {
            reject(receiver.answeredNull(method()));
            return null;
        }
        return followAtHome(answer);
    }

    /**
     * Follows a promise that is still pending: if the instance that began this request ends first, this request is
     * rejected. The request of another call is an exception: its actor settles it, or the end of that actor does.
     */
    @Override
    final void followPending(Promise<? extends T> answer) {
        if (answer instanceof Request<?>) {
            follow(answer);
        } else {
            follow(answer, receiver.life());
        }
    }

    /** Rejects this request; false if it was already settled. */
    public final boolean reject(Throwable error) {
        return settleError(error);
    }

    /** The method with its parameter types, and the actor; not the values of the arguments. */
    @Override
    public final String name() {
        return method() + " of " + receiver;
    }

    /** The name, and the outcome if it is settled. */
    @Override
    public final String toString() {
        return withOutcome(name());
    }

    /** Fulfilled with the value of the first promise when both are fulfilled; cancelling it cancels both. */
    public static Promise<?> both(Promise<?> first, Promise<?> second) {
        return Combinators.ofRequests(first, second);
    }
}
