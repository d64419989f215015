package io.troupe.player.wire;

/** A server has refused a request, or has not answered it in time; the connection stays usable. */
public final class RequestFailedException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public RequestFailedException(String message) {
        super(message);
    }
}
