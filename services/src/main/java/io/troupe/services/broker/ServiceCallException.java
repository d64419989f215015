package io.troupe.services.broker;

import org.jspecify.annotations.Nullable;

/**
 * A call through an {@link ActorConnection} that was not answered; the message names who called, which method, which
 * provider, and why. What a provider itself answers a call with, an error too, comes to the caller as it is.
 */
public final class ServiceCallException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean sent;

    ServiceCallException(String message, boolean sent, @Nullable Throwable cause) {
        super(Reasons.oneLine(message), cause);
        this.sent = sent;
    }

    /**
     * Whether it was sent to a provider, which may have done what was asked; if false, nobody has, and it can be
     * repeated safely.
     */
    public boolean wasSent() {
        return sent;
    }
}
