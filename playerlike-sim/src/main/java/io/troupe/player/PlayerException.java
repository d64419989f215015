package io.troupe.player;

/** An error between a client and its Player server. */
public class PlayerException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public PlayerException() {}

    public PlayerException(String message) {
        super(message);
    }

    public PlayerException(String message, Throwable cause) {
        super(message, cause);
    }

    public PlayerException(Throwable cause) {
        super(cause);
    }
}
