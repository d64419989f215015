package io.troupe.player.wire;

/** The line between a client and its server has been closed, by either of them. */
public final class LineClosedException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public LineClosedException(String message) {
        super(message);
    }
}
