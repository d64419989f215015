package io.troupe.player.wire;

/** Bytes that violate the Player protocol. The message names the field, its value and the expected value. */
final class WireException extends Exception {
    private static final long serialVersionUID = 1L;

    WireException(String message) {
        super(message, null, false, false); // no stack trace: garbage from a client must stay cheap
    }
}
