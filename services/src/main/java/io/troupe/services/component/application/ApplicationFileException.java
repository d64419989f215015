package io.troupe.services.component.application;

/** A declaration that cannot be read: {@code file:line:column}, what is wrong, and what was expected. */
public final class ApplicationFileException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ApplicationFileException(String message) {
        super(message);
    }
}
