package io.troupe.player.wire;

/** What a message says, without its address and time. */
record Content(int subtype, byte[] payload) {
    static final byte[] NONE = {};

    static Content empty(int subtype) {
        return new Content(subtype, NONE);
    }
}
