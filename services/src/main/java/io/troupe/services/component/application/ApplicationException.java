package io.troupe.services.component.application;

/** Thrown if an application cannot run as declared. */
public final class ApplicationException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ApplicationException(String message) {
        super(message);
    }
}
