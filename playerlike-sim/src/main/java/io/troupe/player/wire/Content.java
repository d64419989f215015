package io.troupe.player.wire;

/** Subtype and payload of a message, without address and time. */
record Content(int subtype, byte[] payload) {
    static final byte[] NONE = {};

    static Content empty(int subtype) {
        return new Content(subtype, NONE);
    }
}
