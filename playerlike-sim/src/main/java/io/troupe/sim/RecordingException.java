package io.troupe.sim;

/**
 * A recording that cannot be read, does not belong to this world, or is not what the world does; the message says
 * where.
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
