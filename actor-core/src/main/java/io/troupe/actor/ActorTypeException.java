package io.troupe.actor;

/**
 * A type that cannot be an actor's; the message names the method at fault and says what to do. Thrown by {@code spawn}.
 */
public final class ActorTypeException extends ActorException {
    private static final long serialVersionUID = 1L;

    ActorTypeException(String message) {
        super(message);
    }

    ActorTypeException(String message, Throwable cause) {
        super(message, cause);
    }
}
