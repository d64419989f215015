package io.troupe.broker;

import org.jspecify.annotations.Nullable;

/**
 * A call through an {@link ActorConnection} that was not answered. The message names the caller, the method, the
 * provider and the reason. Answers of the provider, including its errors, are passed to the caller unchanged.
 *
 * <p>Users meet it as the error of a call through {@link ActorConnection#actor}.
 */
public final class ServiceCallException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean sent;

    ServiceCallException(String message, boolean sent, @Nullable Throwable cause) {
        super(Reasons.oneLine(message), cause);
        this.sent = sent;
    }

    /**
     * Returns whether the call was sent to a provider, which may have executed it. If false, no provider has executed
     * it or will, and it is safe to repeat it.
     */
    public boolean wasSent() {
        return sent;
    }
}
