package io.troupe.services.bus;

/**
 * What an answerer failed with, as it can leave a process: the error's class name and message, not the error itself.
 */
public final class RemoteFailure extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final String type;

    public RemoteFailure(Address answerer, String operation, String type, String message) {
        super(answerer + " failed to answer " + operation + ": " + type + ": " + message);
        this.type = type;
    }

    /** The class name of the answerer's error. */
    public String type() {
        return type;
    }
}
