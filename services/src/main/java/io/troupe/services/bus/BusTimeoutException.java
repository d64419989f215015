package io.troupe.services.bus;

/** A question that found no answer within its limit: what was asked for may have been done, or may be done later. */
public final class BusTimeoutException extends BusException {
    private static final long serialVersionUID = 1L;

    public BusTimeoutException(String message) {
        super(message);
    }
}
