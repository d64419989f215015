package io.troupe.actor;

/**
 * Thrown by {@code spawn} for a type that cannot be an actor type; the message names the method at fault and what to
 * do.
 *
 * {@snippet :
 * interface Greeting {
 *     String greet(String name); // returns neither void nor a promise
 * }
 *
 * space.spawn(Greeting.class, () -> name -> "Hello, " + name); // throws
 * }
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
