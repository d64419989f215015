package io.troupe.player.wire;

import java.nio.ByteBuffer;

/** An encoded message: header and payload. The payload is not modified after construction. */
record WireMessage(Header header, byte[] payload) {
    static WireMessage of(DeviceAddress address, MessageType type, int subtype, double timeSeconds, byte[] payload) {
        return new WireMessage(new Header(address, type, subtype, timeSeconds, 0, payload.length), payload);
    }

    byte[] bytes() {
        var buffer = ByteBuffer.allocate(Header.BYTES + payload.length);
        header.write(buffer);
        return buffer.put(payload).array();
    }

    @Override
    public String toString() {
        return Interfaces.name(header.address().interfaceCode()) + ":"
                + header.address().index() + " " + header.type() + "/" + header.subtype() + " of " + payload.length
                + " bytes";
    }
}
