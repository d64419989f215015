package io.troupe.sim;

/**
 * A recording cannot be read, belongs to another world, or differs from what the world does. The message contains the
 * line number where there is one.
 */
public final class RecordingException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    RecordingException(String message) {
        super(message);
    }

    RecordingException(String message, Throwable cause) {
        super(message, cause);
    }
}
