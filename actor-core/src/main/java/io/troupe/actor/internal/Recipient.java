package io.troupe.actor.internal;

import io.troupe.actor.Request;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.TurnOwner;
import org.jspecify.annotations.Nullable;

/**
 * The actor behind a proxy, as its messages and requests see it. For generated code.
 *
 * <p>A class with one subclass, not an interface: the virtual machine calls its methods directly.
 *
 * <p><b>Threads.</b> The two {@code send} and {@link #returning} from any thread, the rest on the space's thread.
 */
public abstract class Recipient {
    protected Recipient() {}

    /** Puts a message into the actor's mailbox. */
    public abstract void send(Message message);

    /** Puts a request into the actor's mailbox. */
    public abstract void send(Request<?> request);

    /** Wraps an argument that is a callback, so that what the actor sends arrives in the caller's callback queue. */
    public abstract @Nullable Object returning(@Nullable Object callback);

    /** Identity, for the {@code equals} of a proxy. */
    public static boolean same(Object first, @Nullable Object second) {
        return first == second;
    }

    /**
     * Begins the turn of a one-way message.
     *
     * @return the target to invoke, or null if the message was already handled or rejected
     */
    public abstract @Nullable Object target(Message message);

    /**
     * Begins the turn of a request.
     *
     * @return the target to invoke, or null if the request was already handled or rejected
     */
    public abstract @Nullable Object target(Request<?> request);

    public abstract Home home();

    /** The incarnation that owns the requests that begin now. */
    public abstract TurnOwner life();

    /**
     * Reports a failure and applies supervision.
     *
     * @param what the one-way message that failed, or what else did, in words
     */
    public abstract void failed(Object what, Throwable thrown);

    /**
     * Called when an exception of a request has rejected it: applies supervision if that counts such exceptions.
     *
     * @param isReported true if it is reported in any case
     */
    public abstract void requestFailed(Request<?> request, Throwable thrown, boolean isReported);

    /** Called when a request was cancelled; by any thread. */
    public abstract void cancelled(Request<?> request);

    /** Called when a time limit on a request has passed; by any thread. */
    public abstract void timedOut(Request<?> request);

    /** The error of a request whose method returned null. */
    public abstract RuntimeException answeredNull(String method);

    /** See {@link Request#progress}. */
    public abstract String progressOf(Request<?> request);
}
