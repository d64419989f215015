package io.troupe.player.wire;

import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;

/**
 * Reads a payload in Player's variant of XDR.
 *
 * <p><b>Errors.</b> {@link WireException} if a field does not fit. A count is accepted only if the payload has enough
 * bytes for it.
 *
 * <p><b>Source.</b> RFC 4506; Player writes the count of an array twice.
 */
final class XdrReader {
    /** Reads one element of an array. */
    interface Element<T> {
        T read(XdrReader from) throws WireException;
    }

    private final String subject;
    private final ByteBuffer bytes;

    /** @param subject name of the payload, for error messages */
    XdrReader(String subject, byte[] payload) {
        this.subject = subject;
        this.bytes = ByteBuffer.wrap(payload);
    }

    int remaining() {
        return bytes.remaining();
    }

    int int32(String field) throws WireException {
        need(field, 4);
        return bytes.getInt();
    }

    int uint16(String field) throws WireException {
        return small(field, 0xFFFF);
    }

    int uint8(String field) throws WireException {
        return small(field, 0xFF);
    }

    private int small(String field, int limit) throws WireException {
        int value = int32(field);
        if (Integer.compareUnsigned(value, limit) > 0) {
            throw new WireException(
                    subject + ": " + field + " is " + Integer.toUnsignedString(value) + ", expected 0 to " + limit);
        }
        return value;
    }

    boolean bool(String field) throws WireException {
        return uint8(field) != 0;
    }

    float float32(String field) throws WireException {
        need(field, 4);
        return bytes.getFloat();
    }

    double float64(String field) throws WireException {
        need(field, 8);
        return bytes.getDouble();
    }

    /** An array whose elements have a fixed size in bytes. */
    <T> List<T> array(String field, int elementBytes, Element<T> element) throws WireException {
        int count = count(field, elementBytes);
        var elements = new ArrayList<T>(count);
        for (int i = 0; i < count; i++) {
            elements.add(element.read(this));
        }
        return elements;
    }

    /** An array of bytes, padded to a multiple of four. */
    byte[] opaque(String field) throws WireException {
        int count = count(field, 1);
        var content = new byte[count];
        bytes.get(content);
        int padding = -count & 3;
        need("padding of " + field, padding);
        bytes.position(bytes.position() + padding);
        return content;
    }

    /** A string up to its first NUL. */
    String string(String field) throws WireException {
        byte[] content = opaque(field);
        int length = 0;
        while (length < content.length && content[length] != 0) {
            length++;
        }
        return new String(content, 0, length, StandardCharsets.UTF_8);
    }

    private int count(String field, int elementBytes) throws WireException {
        int count = int32("count of " + field);
        int again = int32("second count of " + field);
        if (count != again) {
            throw new WireException(subject + ": count of " + field + " is " + Integer.toUnsignedString(count)
                    + ", then " + Integer.toUnsignedString(again) + ", expected the same twice");
        }
        if (Integer.toUnsignedLong(count) * elementBytes > bytes.remaining()) {
            throw new WireException(subject + ": count of " + field + " is " + Integer.toUnsignedString(count)
                    + ", expected at most " + bytes.remaining() / elementBytes + " for the " + bytes.remaining()
                    + " bytes that follow");
        }
        return count;
    }

    /** Throws if bytes are left. */
    void end() throws WireException {
        if (bytes.hasRemaining()) {
            throw new WireException(subject + ": size is " + bytes.capacity() + ", expected " + bytes.position());
        }
    }

    private void need(String field, int size) throws WireException {
        if (bytes.remaining() < size) {
            throw new WireException(subject + ": size is " + bytes.capacity() + ", expected " + size + " bytes for "
                    + field + " at offset " + bytes.position());
        }
    }
}
