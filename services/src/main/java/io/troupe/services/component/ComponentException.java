package io.troupe.services.component;

import org.jspecify.annotations.Nullable;

/** A component that does not do what was asked of it; the message names it, how it is, and why. */
public final class ComponentException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ComponentException(String message) {
        super(message);
    }

    public ComponentException(String message, @Nullable Throwable cause) {
        super(message, cause);
    }
}
