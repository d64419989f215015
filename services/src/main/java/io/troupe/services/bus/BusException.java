package io.troupe.services.bus;

/**
 * A message that the bus could not deliver, or a question without an answer; the message names who asked whom for what.
 */
public sealed class BusException extends RuntimeException permits BusTimeoutException {
    private static final long serialVersionUID = 1L;

    public BusException(String message) {
        super(message);
    }
}
