package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/**
 * Base class of the exceptions that an actor or its space throws.
 *
 * {@snippet :
 * Promise<String> answer = greeter.greet("Ada")
 *         .exceptionally(error -> error instanceof ActorException ? "the greeter is gone" : "the greeter failed");
 * }
 */
public class ActorException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ActorException(String message) {
        super(message);
    }

    public ActorException(String message, @Nullable Throwable cause) {
        super(message, cause);
    }

    ActorException(String message, @Nullable Throwable cause, boolean enableSuppression, boolean writableStackTrace) {
        super(message, cause, enableSuppression, writableStackTrace);
    }
}
