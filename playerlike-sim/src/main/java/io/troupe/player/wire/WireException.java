package io.troupe.player.wire;

/** Bytes that are not what the Player protocol says; the message names the field, its value and what was expected. */
final class WireException extends Exception {
    private static final long serialVersionUID = 1L;

    WireException(String message) {
        super(message, null, false, false); // no trace: whoever sends garbage shall not make us work
    }
}
