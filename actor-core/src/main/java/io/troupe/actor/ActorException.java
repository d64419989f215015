package io.troupe.actor;

/** What is wrong with an actor or its space; the parent of this room's exceptions. */
public class ActorException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ActorException(String message) {
        super(message);
    }

    public ActorException(String message, Throwable cause) {
        super(message, cause);
    }
}
