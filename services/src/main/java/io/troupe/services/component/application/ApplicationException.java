package io.troupe.services.component.application;

/** An application that cannot run as it was declared. */
public final class ApplicationException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ApplicationException(String message) {
        super(message);
    }
}
