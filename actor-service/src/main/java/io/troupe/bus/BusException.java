package io.troupe.bus;

import io.troupe.actor.Unanswered;

/**
 * A message could not be delivered, or a request got no reply. The message names the requester, the receiver and the
 * operation.
 *
 * <p>Users meet it as the error of {@link BusPort#ask}, and when they use a port that is closed.
 */
public sealed class BusException extends RuntimeException implements Unanswered permits BusTimeoutException {
    private static final long serialVersionUID = 1L;

    private final boolean mayHaveRun;

    /** An error of a message that no handler has received. */
    public BusException(String message) {
        this(message, false);
    }

    /** The same with a cause. */
    public BusException(String message, Throwable cause) {
        super(message, cause);
        this.mayHaveRun = false;
    }

    BusException(String message, boolean mayHaveRun) {
        super(message);
        this.mayHaveRun = mayHaveRun;
    }

    /**
     * Returns whether a handler may have received the request: the limit is over, the connection or the requester's
     * port was closed, the handler left after it had begun, or its reply could not be sent or read. If false, the
     * request was not handled and will not be, and it is safe to repeat it: the node or the port does not exist, has no
     * handler for the operation, cannot read the request, has too many of them, or got to it too late; or the request
     * could not be encoded or sent.
     */
    @Override
    public boolean mayHaveRun() {
        return mayHaveRun;
    }
}
