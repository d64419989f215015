package io.troupe.services.component.kinds;

/**
 * Thrown for a parameter value that a kind of component does not accept. The message has no file position; the reader
 * of the file adds it.
 */
public final class ArgumentException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final String parameter;

    public ArgumentException(String parameter, String message) {
        super(message);
        this.parameter = parameter;
    }

    /** The name of the parameter. */
    public String parameter() {
        return parameter;
    }
}
