package io.troupe.bus;

/**
 * The failure of a request handler in a form that can leave its process: the class name and message of the error, not
 * the error itself.
 *
 * <p>Users meet it as the error of {@link BusPort#ask}.
 */
public final class RemoteFailure extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final String type;
    private final String problem;

    public RemoteFailure(Address receiver, String operation, String type, String message) {
        super(receiver + " failed to answer " + operation + ": " + type + ": " + message);
        this.type = type;
        this.problem = message;
    }

    /** The class name of the handler's error. */
    public String type() {
        return type;
    }

    /** The message of the handler's error. */
    public String problem() {
        return problem;
    }
}
