package io.troupe.bus;

/**
 * A message could not be delivered, or a request got no reply. The message names the requester, the receiver and the
 * operation.
 *
 * <p>Users meet it as the error of {@link BusPort#ask}, and when they use a port that is closed.
 */
public sealed class BusException extends RuntimeException permits BusTimeoutException {
    private static final long serialVersionUID = 1L;

    public BusException(String message) {
        super(message);
    }

    public BusException(String message, Throwable cause) {
        super(message, cause);
    }
}
