package io.troupe.view.tools;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.tools.Thorough;
import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.EOFException;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.HexFormat;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class WebSocketTest {
    private final ByteArrayOutputStream in = new ByteArrayOutputStream();
    private final ByteArrayOutputStream out = new ByteArrayOutputStream();

    /** Adds a masked frame to the input. */
    private void frame(int first, byte[] content) {
        in.write(first);
        if (content.length < 126) {
            in.write(0x80 | content.length);
        } else if (content.length < 0x10000) {
            in.writeBytes(ByteBuffer.allocate(3)
                    .put((byte) (0x80 | 126))
                    .putShort((short) content.length)
                    .array());
        } else {
            in.writeBytes(ByteBuffer.allocate(9)
                    .put((byte) (0x80 | 127))
                    .putLong(content.length)
                    .array());
        }
        byte[] mask = {1, 2, 3, 4};
        in.writeBytes(mask);
        for (int i = 0; i < content.length; i++) {
            in.write(content[i] ^ mask[i & 3]);
        }
    }

    private void frame(int first, String text) {
        frame(first, text.getBytes(StandardCharsets.UTF_8));
    }

    private WebSocket socket() {
        return new WebSocket(new ByteArrayInputStream(in.toByteArray()), out);
    }

    private String written() {
        return HexFormat.of().formatHex(out.toByteArray());
    }

    @Test
    void keyOfTheRfc_hasItsAnswer() {
        assertThat(WebSocket.accept("dGhlIHNhbXBsZSBub25jZQ==")).isEqualTo("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
    }

    @Test
    void messages_areRead_inPartsToo_withAPingBetween() throws IOException {
        frame(0x81, "whole");
        frame(0x01, "in ");
        frame(0x89, "ping");
        frame(0x00, "three ");
        frame(0x80, "parts");
        frame(0x82, new byte[] {7});
        frame(0x81, "x".repeat(70_000));
        WebSocket socket = socket();
        assertThat(socket.read()).extracting(WebSocket.Message::text).isEqualTo("whole");
        assertThat(socket.read()).extracting(WebSocket.Message::text).isEqualTo("in three parts");
        assertThat(written()).as("pong").isEqualTo("8a0470696e67");
        assertThat(socket.read()).extracting(WebSocket.Message::text).isNull();
        assertThat(socket.read()).extracting(WebSocket.Message::text).isEqualTo("x".repeat(70_000));
        assertThat(socket.read()).as("after the end").isNull();
    }

    @Test
    void messages_areWritten_withLengthsOfThreeSizes() throws IOException {
        WebSocket socket = socket();
        socket.sendText("hé");
        assertThat(written()).isEqualTo("810368c3a9");
        out.reset();
        socket.sendBinary(new byte[126]);
        assertThat(written()).startsWith("827e007e00").hasSize(2 * (4 + 126));
        out.reset();
        socket.sendBinary(new byte[0x10000]);
        assertThat(written()).startsWith("827f000000000001000000").hasSize(2 * (10 + 0x10000));
    }

    @Test
    void closing_isAnsweredOnce_andNothingFollows() throws IOException {
        frame(0x88, new byte[] {3, (byte) 0xe8});
        WebSocket socket = socket();
        assertThat(socket.read()).isNull();
        socket.sendText("more");
        socket.close(WebSocket.GOING_AWAY, "again");
        assertThat(written()).isEqualTo("880203e8");
    }

    @ParameterizedTest
    @CsvSource({
        "81 05 68656c6c6f, 1002, not masked",
        "c1 80 01020304, 1002, a reserved bit",
        "83 80 01020304, 1002, an unknown opcode",
        "80 80 01020304, 1002, a continuation of nothing",
        "09 80 01020304, 1002, a ping in parts",
        "89 fe 0080, 1002, a long ping",
        "01 80 01020304 81 80 01020304, 1002, a message within a message",
        "81 81 00000000 ff, 1007, no UTF-8",
        "81 ff 0000000000100001 01020304, 1009, too long",
        "81 ff ffffffffffffffff 01020304, 1009, a negative length",
    })
    void violation_endsTheConnectionWithItsCode(String frame, int code, String what) throws IOException {
        in.writeBytes(HexFormat.of().parseHex(frame.replace(" ", "")));
        assertThat(socket().read()).as(what).isNull();
        byte[] close = out.toByteArray();
        assertThat(close[0]).isEqualTo((byte) 0x88);
        assertThat(ByteBuffer.wrap(close, 2, 2).getShort()).as(what).isEqualTo((short) code);
    }

    @Test
    void randomBytes_endTheConnection() throws IOException {
        long seed = new Random().nextLong();
        var random = new Random(seed);
        for (int round = 0; round < Thorough.times(2_000, 20_000); round++) {
            byte[] bytes = new byte[random.nextInt(60)];
            random.nextBytes(bytes);
            if (bytes.length > 1 && random.nextBoolean()) {
                bytes[0] &= (byte) 0x8f; // no reserved bits
                bytes[1] |= (byte) 0x80;
            }
            var socket = new WebSocket(new ByteArrayInputStream(bytes), out);
            try {
                for (int messages = 0; socket.read() != null; messages++) {
                    assertThat(messages).as("seed %d, round %d", seed, round).isLessThan(60);
                }
            } catch (EOFException cut) {
                assertThat(bytes).as("seed %d, round %d", seed, round).isNotEmpty();
            }
            out.reset();
        }
    }
}
