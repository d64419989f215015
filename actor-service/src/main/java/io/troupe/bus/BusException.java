package io.troupe.bus;

/**
 * A message could not be delivered, or a request got no reply. The message names the requester, the receiver and the
 * operation.
 */
public sealed class BusException extends RuntimeException permits BusTimeoutException {
    private static final long serialVersionUID = 1L;

    public BusException(String message) {
        super(message);
    }
}
