package io.troupe.view.tools;

import java.io.BufferedOutputStream;
import java.io.DataInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.util.Base64;
import org.jspecify.annotations.Nullable;

/**
 * The server's end of a WebSocket, after the upgrade.
 *
 * <p><b>Threads.</b> One thread reads; any thread writes.
 *
 * <p><b>Errors.</b> What the client does against the protocol ends the connection with the code that the protocol has
 * for it, and {@link #read} returns null, as after an orderly end.
 *
 * <p><b>Source.</b> RFC 6455, without extensions.
 */
final class WebSocket {
    /** A longer message from a client ends the connection. */
    static final int MOST_BYTES = 1 << 20;

    static final int NORMAL = 1000;
    static final int GOING_AWAY = 1001;
    private static final int PROTOCOL_ERROR = 1002;
    private static final int NO_TEXT = 1007;
    private static final int TOO_LONG = 1009;

    private static final int CONTINUATION = 0;
    private static final int TEXT = 1;
    private static final int BINARY = 2;
    private static final int CLOSE = 8;
    private static final int PING = 9;
    private static final int PONG = 10;
    private static final int FINAL = 0x80;
    private static final int MASKED = 0x80;
    private static final int MOST_CONTROL_BYTES = 125;
    private static final String KEY_SUFFIX = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";

    /** A whole message; {@code text} is null if it is a binary one. */
    record Message(@Nullable String text, byte[] bytes) {}

    /** A frame with its content, unmasked. */
    private record Frame(boolean isFinal, int opcode, byte[] content) {}

    /** The connection has to be closed. */
    private static final class Violation extends Exception {
        private static final long serialVersionUID = 1L;

        private final int code;

        Violation(int code, String reason) {
            super(reason);
            this.code = code;
        }
    }

    private final DataInputStream in;
    private final OutputStream out;
    private boolean closed;

    WebSocket(InputStream in, OutputStream out) {
        this.in = new DataInputStream(in);
        this.out = new BufferedOutputStream(out, 1 << 16);
    }

    /** The answer to the key of a client. */
    static String accept(String key) {
        try {
            byte[] hash =
                    MessageDigest.getInstance("SHA-1").digest((key + KEY_SUFFIX).getBytes(StandardCharsets.ISO_8859_1));
            return Base64.getEncoder().encodeToString(hash);
        } catch (NoSuchAlgorithmException e) {
            throw new IllegalStateException("every Java platform has SHA-1", e);
        }
    }

    // ---- reading

    /** Waits for the next message; null after the end. Pings are answered. */
    @Nullable
    Message read() throws IOException {
        try {
            return message();
        } catch (Violation violation) {
            close(violation.code, String.valueOf(violation.getMessage()));
            return null;
        }
    }

    private @Nullable Message message() throws IOException, Violation {
        int opcode = CONTINUATION;
        byte[] content = new byte[0];
        while (true) {
            Frame frame = frame();
            if (frame == null) {
                return null;
            }
            if (frame.opcode >= CLOSE) {
                if (control(frame)) {
                    return null;
                }
                continue;
            }
            if ((frame.opcode == CONTINUATION) == (opcode == CONTINUATION)) {
                throw new Violation(PROTOCOL_ERROR, "a part of a message is out of order");
            }
            opcode = opcode == CONTINUATION ? frame.opcode : opcode;
            content = join(content, frame.content);
            if (frame.isFinal) {
                return opcode == TEXT ? new Message(text(content), content) : new Message(null, content);
            }
        }
    }

    private static byte[] join(byte[] first, byte[] second) throws Violation {
        if (first.length + second.length > MOST_BYTES) {
            throw tooLong();
        }
        return ByteBuffer.allocate(first.length + second.length)
                .put(first)
                .put(second)
                .array();
    }

    private static Violation tooLong() {
        return new Violation(TOO_LONG, "expected messages of at most " + MOST_BYTES + " bytes");
    }

    private static String text(byte[] content) throws Violation {
        try {
            return StandardCharsets.UTF_8
                    .newDecoder()
                    .decode(ByteBuffer.wrap(content))
                    .toString();
        } catch (CharacterCodingException e) {
            throw new Violation(NO_TEXT, "expected UTF-8");
        }
    }

    private @Nullable Frame frame() throws IOException, Violation {
        int first = in.read();
        if (first < 0) {
            return null;
        }
        int second = in.readUnsignedByte();
        int opcode = first & 0x0f;
        boolean isControl = opcode >= CLOSE;
        boolean isFinal = (first & FINAL) != 0;
        if ((first & 0x70) != 0
                || opcode > PONG
                || opcode > BINARY && opcode < CLOSE
                || (second & MASKED) == 0
                || isControl && (!isFinal || (second & 0x7f) > MOST_CONTROL_BYTES)) {
            throw new Violation(PROTOCOL_ERROR, "expected a masked frame of RFC 6455 without extensions");
        }
        long length = second & 0x7f;
        if (length == 126) {
            length = in.readUnsignedShort();
        } else if (length == 127) {
            length = in.readLong();
        }
        if (length < 0 || length > MOST_BYTES) {
            throw tooLong();
        }
        byte[] mask = new byte[4];
        in.readFully(mask);
        byte[] content = new byte[(int) length];
        in.readFully(content);
        for (int i = 0; i < content.length; i++) {
            content[i] ^= mask[i & 3];
        }
        return new Frame(isFinal, opcode, content);
    }

    /** Returns whether the connection ends. */
    private boolean control(Frame frame) throws IOException {
        if (frame.opcode == PING) {
            write(PONG, frame.content);
        } else if (frame.opcode == CLOSE) {
            close(NORMAL, "");
        }
        return frame.opcode == CLOSE;
    }

    // ---- writing

    void sendText(String text) throws IOException {
        write(TEXT, text.getBytes(StandardCharsets.UTF_8));
    }

    void sendBinary(byte[] content) throws IOException {
        write(BINARY, content);
    }

    /** Ends the connection without further words. */
    void abort() throws IOException {
        in.close();
    }

    /** Announces the end, once. */
    void close(int code, String reason) throws IOException {
        byte[] text = reason.getBytes(StandardCharsets.UTF_8);
        ByteBuffer content = ByteBuffer.allocate(Short.BYTES + text.length).putShort((short) code);
        write(CLOSE, content.put(text).array());
    }

    private synchronized void write(int opcode, byte[] content) throws IOException {
        if (closed) {
            return;
        }
        closed = opcode == CLOSE;
        out.write(FINAL | opcode);
        if (content.length <= MOST_CONTROL_BYTES) {
            out.write(content.length);
        } else if (content.length <= 0xFFFF) {
            out.write(126);
            out.write(content.length >>> 8);
            out.write(content.length);
        } else {
            out.write(127);
            out.write(ByteBuffer.allocate(Long.BYTES).putLong(content.length).array());
        }
        out.write(content);
        out.flush();
    }
}
