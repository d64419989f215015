package io.troupe.services.component.application;

/**
 * Thrown for an application file that cannot be read; the message has {@code file:line:column}, the error, and what was
 * expected.
 */
public final class ApplicationFileException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ApplicationFileException(String message) {
        super(message);
    }
}
