package io.troupe.player.wire;

import java.nio.ByteBuffer;

/**
 * The header of every message: 40 bytes, big-endian.
 *
 * @param sequence 0 from all known clients; replies of the player device repeat it
 * @param size size of the payload in bytes
 */
record Header(DeviceAddress address, MessageType type, int subtype, double timeSeconds, int sequence, int size) {
    static final int BYTES = 40;
    private static final int MAX_SHORT = 0xFFFF;
    private static final int MAX_BYTE = 0xFF;

    /** Reads the next 40 bytes; the buffer must contain them. */
    static Header read(ByteBuffer from, int maxPayloadBytes) throws WireException {
        int host = from.getInt();
        int robot = from.getInt();
        int interfaceCode = atMost(MAX_SHORT, "interface", from.getInt());
        int index = atMost(MAX_SHORT, "index", from.getInt());
        MessageType type = MessageType.of(from.getInt());
        int subtype = atMost(MAX_BYTE, "subtype", from.getInt());
        double timeSeconds = from.getDouble();
        int sequence = from.getInt();
        int size = atMost(maxPayloadBytes, "size", from.getInt());
        return new Header(
                new DeviceAddress(host, robot, interfaceCode, index), type, subtype, timeSeconds, sequence, size);
    }

    private static int atMost(int limit, String field, int value) throws WireException {
        if (Integer.compareUnsigned(value, limit) > 0) {
            throw new WireException(
                    "header " + field + " is " + Integer.toUnsignedString(value) + ", expected 0 to " + limit);
        }
        return value;
    }

    void write(ByteBuffer to) {
        to.putInt(address.host())
                .putInt(address.robot())
                .putInt(address.interfaceCode())
                .putInt(address.index())
                .putInt(type.code())
                .putInt(subtype)
                .putDouble(timeSeconds)
                .putInt(sequence)
                .putInt(size);
    }
}
