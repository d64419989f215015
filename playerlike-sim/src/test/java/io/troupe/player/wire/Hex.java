package io.troupe.player.wire;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.HexFormat;
import java.util.List;

/** Bytes as hexadecimal text, as in the examples of the protocol and in captured conversations. */
final class Hex {
    /** @param sender C for the client, S for the server */
    record Line(char sender, byte[] bytes) {
        WireMessage message() {
            return Hex.message(bytes);
        }
    }

    private Hex() {}

    /** Spaces and bars only separate. */
    static byte[] bytes(String hex) {
        return HexFormat.of().parseHex(hex.replaceAll("[ |\\n]", ""));
    }

    static String text(byte[] bytes) {
        return HexFormat.of().formatHex(bytes);
    }

    static WireMessage message(byte[] bytes) {
        var in = new ByteArrayInputStream(bytes);
        try {
            WireMessage message = new MessageReader(in, 1 << 20).read();
            if (message == null || in.available() > 0) {
                throw new AssertionError("not exactly one message: " + text(bytes));
            }
            return message;
        } catch (IOException | WireException e) {
            throw new AssertionError("not a message: " + text(bytes), e);
        }
    }

    /** A captured conversation. */
    static List<Line> capture(String name) {
        try (var in = Hex.class.getResourceAsStream(name)) {
            return new String(in.readAllBytes(), StandardCharsets.US_ASCII)
                    .lines()
                    .filter(line -> !line.startsWith("#"))
                    .map(line -> new Line(line.charAt(0), bytes(line.substring(2))))
                    .toList();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }
}
