package io.troupe.player.wire;

/** The connection between a client and its server was closed, by either side. */
public final class ConnectionClosedException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public ConnectionClosedException(String message) {
        super(message);
    }
}
