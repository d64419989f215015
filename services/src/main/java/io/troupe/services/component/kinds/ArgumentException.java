package io.troupe.services.component.kinds;

/** A value that a kind of component cannot take; the message has no position, that is for whoever read it. */
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
