package io.troupe.player.wire;

import java.io.EOFException;
import java.io.IOException;
import java.io.InputStream;
import java.nio.ByteBuffer;
import org.jspecify.annotations.Nullable;

/**
 * Cuts a stream of bytes into messages.
 *
 * <p><b>Errors.</b> After a {@link WireException} nobody knows where the next message begins: the stream is of no use
 * any more.
 *
 * <p><b>Cost.</b> Takes memory for bytes that have arrived, not for those that a header announces.
 */
final class MessageReader {
    private final InputStream in;
    private final int maxPayloadBytes;

    MessageReader(InputStream in, int maxPayloadBytes) {
        this.in = in;
        this.maxPayloadBytes = maxPayloadBytes;
    }

    /**
     * Waits for the next message; null if the stream ends before it begins.
     *
     * @throws WireException if a header is not one
     * @throws EOFException if the stream ends within a message
     */
    @Nullable
    Message read() throws IOException, WireException {
        byte[] head = in.readNBytes(Header.BYTES);
        if (head.length == 0) {
            return null;
        }
        if (head.length < Header.BYTES) {
            throw new EOFException(
                    "the stream ended after " + head.length + " bytes of a header, expected " + Header.BYTES);
        }
        Header header = Header.read(ByteBuffer.wrap(head), maxPayloadBytes);
        byte[] payload = in.readNBytes(header.size()); // grows with what arrives
        if (payload.length < header.size()) {
            throw new EOFException(
                    "the stream ended after " + payload.length + " bytes of a payload, expected " + header.size());
        }
        return new Message(header, payload);
    }
}
