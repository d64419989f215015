package io.troupe.player.wire;

/** The type field of a message's header. */
enum MessageType {
    DATA(1),
    CMD(2),
    REQ(3),
    ACK(4),
    SYNCH(5),
    NACK(6);

    private final int code;

    MessageType(int code) {
        this.code = code;
    }

    int code() {
        return code;
    }

    static MessageType of(int code) throws WireException {
        for (var each : values()) {
            if (each.code == code) {
                return each;
            }
        }
        throw new WireException("header type is " + Integer.toUnsignedString(code) + ", expected 1 to 6");
    }
}
