package io.troupe.player.wire;

/** The connection between a client and its server was closed, by either side. */
public final class LineClosedException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public LineClosedException(String message) {
        super(message);
    }
}
