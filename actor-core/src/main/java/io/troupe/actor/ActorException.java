package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/** What is wrong with an actor or its space; the parent of this room's exceptions. */
public class ActorException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ActorException(String message) {
        super(message);
    }

    public ActorException(String message, @Nullable Throwable cause) {
        super(message, cause);
    }
}
