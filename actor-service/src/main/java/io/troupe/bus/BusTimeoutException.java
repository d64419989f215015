package io.troupe.bus;

/**
 * A request got no reply within its limit. The operation may have been carried out, or may be carried out later.
 *
 * <p>Users meet it as the error of {@link BusPort#ask}.
 */
public final class BusTimeoutException extends BusException {
    private static final long serialVersionUID = 1L;

    public BusTimeoutException(String message) {
        super(message, true);
    }
}
