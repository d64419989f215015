package io.troupe.player.wire;

import java.io.EOFException;
import java.io.IOException;
import java.io.InputStream;
import java.nio.ByteBuffer;
import org.jspecify.annotations.Nullable;

/**
 * Splits a stream of bytes into messages.
 *
 * <p><b>Errors.</b> After a {@link WireException} the position of the next message is unknown, so the stream cannot be
 * used any further.
 *
 * <p><b>Cost.</b> Allocates memory for bytes that have arrived, not for the size that a header announces.
 */
final class MessageReader {
    private final InputStream in;
    private final int maxPayloadBytes;

    MessageReader(InputStream in, int maxPayloadBytes) {
        this.in = in;
        this.maxPayloadBytes = maxPayloadBytes;
    }

    /**
     * Waits for the next message; null at the end of the stream.
     *
     * @throws WireException if a header is invalid
     * @throws EOFException if the stream ends within a message
     */
    @Nullable
    WireMessage read() throws IOException, WireException {
        byte[] head = in.readNBytes(Header.BYTES);
        if (head.length == 0) {
            return null;
        }
        if (head.length < Header.BYTES) {
            throw new EOFException(
                    "the stream ended after " + head.length + " bytes of a header, expected " + Header.BYTES);
        }
        Header header = Header.read(ByteBuffer.wrap(head), maxPayloadBytes);
        byte[] payload = in.readNBytes(header.size()); // grows with the bytes that arrive
        if (payload.length < header.size()) {
            throw new EOFException(
                    "the stream ended after " + payload.length + " bytes of a payload, expected " + header.size());
        }
        return new WireMessage(header, payload);
    }
}
