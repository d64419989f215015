package io.troupe.broker;

import io.troupe.actor.Unanswered;
import org.jspecify.annotations.Nullable;

/**
 * A call through an {@link ActorConnection} that was not answered. The message names the caller, the method, the
 * provider and the reason. Answers of the provider, including its errors, are passed to the caller unchanged.
 *
 * <p>Users meet it as the error of a call through {@link ActorConnection#actor}.
 */
public final class ServiceCallException extends RuntimeException implements Unanswered {
    private static final long serialVersionUID = 1L;

    private final boolean mayHaveRun;

    ServiceCallException(String message, boolean mayHaveRun, @Nullable Throwable cause) {
        super(Reasons.oneLine(message), cause);
        this.mayHaveRun = mayHaveRun;
    }

    /**
     * Returns whether the call was sent to a provider, which may have executed it. If false, no provider has executed
     * it or will, and it is safe to repeat it.
     */
    @Override
    public boolean mayHaveRun() {
        return mayHaveRun;
    }
}
