package io.troupe.player.wire;

/** A server has refused a request, or has not answered it in time; the line to it is as it was. */
public final class RequestFailedException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public RequestFailedException(String message) {
        super(message);
    }
}
