package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/**
 * The answer to a request whose actor has stopped, or whose space was closed, before it was answered; or whose actor
 * was restarted after it had begun.
 *
 * <p>The cause is what made the actor stop or restart, if something was thrown.
 */
public final class ActorStoppedException extends ActorException {
    private static final long serialVersionUID = 1L;

    private final boolean begun;

    ActorStoppedException(String message) {
        this(message, null, false);
    }

    ActorStoppedException(String message, @Nullable Throwable cause, boolean begun) {
        super(message, cause);
        this.begun = begun;
    }

    /**
     * Whether the actor had begun the request, so that some of what was asked for may have been done; if not, it can be
     * asked again elsewhere.
     */
    public boolean wasBegun() {
        return begun;
    }
}
