package io.troupe.actor;

/** The answer to a request whose actor has stopped, or whose space is closed, before it was begun. */
public final class ActorStoppedException extends ActorException {
    private static final long serialVersionUID = 1L;

    ActorStoppedException(String message) {
        super(message);
    }
}
