package io.troupe.view.tools;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.view.tools.McapFile.Message;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.jupiter.api.Test;

/** Files written by {@link McapWriter}, read by {@link McapFile}, which checks every record. */
class McapWriterTest {
    private final ByteArrayOutputStream out = new ByteArrayOutputStream();

    private static byte[] utf8(String text) {
        return text.getBytes(StandardCharsets.UTF_8);
    }

    private McapFile written() {
        return new McapFile(out.toByteArray());
    }

    @Test
    void smallFile_hasTheseBytes() throws IOException {
        try (var writer = new McapWriter(out, "lib")) {
            writer.metadata("about", Map.of("seed", "7"));
            int channel = writer.channel(writer.schema("S", "jsonschema", "{}"), "/t", "json", Map.of("k", "v"));
            writer.message(channel, 5, utf8("{\"a\":1}"));
            writer.message(channel, 2, utf8("{}"));
        }
        assertThat(HexFormat.of().formatHex(out.toByteArray())).isEqualTo("""
                894d434150300d0a010b0000000000000000000000030000006c69620c1a000000000000000500000061626f75740d00
                00000400000073656564010000003706bc00000000000000020000000000000005000000000000009400000000000000
                d4007eda000000009400000000000000031b00000000000000010001000000530a0000006a736f6e736368656d610200
                00007b7d04200000000000000000000100020000002f74040000006a736f6e0a000000010000006b0100000076051d00
                000000000000000000000000050000000000000005000000000000007b2261223a317d05180000000000000000000100
                0000020000000000000002000000000000007b7d07260000000000000000002000000005000000000000004d00000000
                000000020000000000000073000000000000000f04000000000000008e449457031b0000000000000001000100000053
                0a0000006a736f6e736368656d61020000007b7d04200000000000000000000100020000002f74040000006a736f6e0a
                000000010000006b01000000760b38000000000000000200000000000000010001000000000000000100000001000000
                020000000000000005000000000000000a000000000002000000000000000d19000000000000001c0000000000000023
                000000000000000500000061626f7574084a00000000000000020000000000000005000000000000003f000000000000
                00c5000000000000000a000000000004010000000000002f000000000000000000000094000000000000009400000000
                0000000e110000000000000003400100000000000024000000000000000e110000000000000004640100000000000029
                000000000000000e11000000000000000b8d0100000000000041000000000000000e11000000000000000dce01000000
                00000022000000000000000e110000000000000008f00100000000000053000000000000000214000000000000004001
                00000000000043020000000000005e501ba2894d434150300d0a""".replaceAll("\\s", ""));
    }

    @Test
    void everythingWritten_isRead() throws IOException {
        try (var writer = new McapWriter(out, "Troupe 1")) {
            int schema = writer.schema("S", "jsonschema", "{\"type\":\"object\"}");
            int first = writer.channel(schema, "/first", "json", Map.of());
            int second = writer.channel(schema, "/größe", "json", Map.of("unit", "m", "about", "ü"));
            writer.message(second, 1_000_000_007, utf8("{\"x\":\"é\"}"));
            writer.message(first, 0, utf8("{}"));
            writer.metadata("run", Map.of("world", "paper arena"));
            writer.message(second, 2_000_000_000, utf8("{}"));
        }
        McapFile file = written();
        assertThat(file.library).isEqualTo("Troupe 1");
        assertThat(file.schemas)
                .containsExactly(Map.entry(1, new McapFile.Schema("S", "jsonschema", "{\"type\":\"object\"}")));
        assertThat(file.channels)
                .containsEntry(0, new McapFile.Channel(1, "/first", "json", Map.of()))
                .containsEntry(1, new McapFile.Channel(1, "/größe", "json", Map.of("about", "ü", "unit", "m")));
        assertThat(file.messages)
                .containsExactly(
                        new Message(1, 0, 1_000_000_007, 1_000_000_007, "{\"x\":\"é\"}"),
                        new Message(0, 0, 0, 0, "{}"),
                        new Message(1, 1, 2_000_000_000, 2_000_000_000, "{}"));
        assertThat(file.metadata).containsExactly(Map.entry("run", Map.of("world", "paper arena")));
        assertThat(file.chunks).as("metadata stands between chunks").isEqualTo(2);
    }

    @Test
    void emptyFile_andChannelWithoutMessages_areValid() throws IOException {
        new McapWriter(out, "").close();
        assertThat(written().chunks).isZero();
        out.reset();
        try (var writer = new McapWriter(out, "")) {
            writer.channel(writer.schema("S", "jsonschema", "{}"), "/t", "json", Map.of());
        }
        McapFile file = written();
        assertThat(file.channels).hasSize(1);
        assertThat(file.messages).isEmpty();
    }

    @Test
    void closingTwice_writesOneEnd() throws IOException {
        var writer = new McapWriter(out, "");
        writer.close();
        int size = out.size();
        writer.close();
        assertThat(out.size()).isEqualTo(size);
    }

    @Test
    void randomFiles_areReadAsWritten() throws IOException {
        long seed = new Random().nextLong();
        var random = new Random(seed);
        for (int round = 0; round < 40; round++) {
            out.reset();
            List<Message> expected = new ArrayList<>();
            List<Long> sequences = new ArrayList<>();
            int metadata = 0;
            try (var writer = new McapWriter(out, "x".repeat(random.nextInt(300)))) {
                int schema = writer.schema("first", "jsonschema", "{}");
                for (int i = random.nextInt(60); i > 0; i--) {
                    switch (random.nextInt(8)) {
                        case 0 -> schema = writer.schema("s" + i, "jsonschema", "y".repeat(random.nextInt(2_000)));
                        case 1 -> {
                            writer.channel(schema, "/" + i, "json", Map.of("a", "" + i));
                            sequences.add(0L);
                        }
                        case 2 -> writer.metadata("m" + metadata++, Map.of());
                        default -> {
                            if (!sequences.isEmpty()) {
                                int channel = random.nextInt(sequences.size());
                                long nanos = random.nextLong(Long.MAX_VALUE);
                                String data = "z".repeat(random.nextInt(random.nextInt(10) == 0 ? 2_000_000 : 500));
                                writer.message(channel, nanos, utf8(data));
                                long sequence = sequences.get(channel);
                                sequences.set(channel, sequence + 1);
                                expected.add(new Message(channel, sequence, nanos, nanos, data));
                            }
                        }
                    }
                }
            }
            McapFile file = written();
            assertThat(file.messages).as("seed %d, round %d", seed, round).isEqualTo(expected);
            assertThat(file.channels).hasSize(sequences.size());
            assertThat(file.metadata).hasSize(metadata);
        }
    }

    @Test
    void chunks_endAtAMegabyte_soThatPartsOfTheFileCanBeRead() throws IOException {
        try (var writer = new McapWriter(out, "")) {
            int channel = writer.channel(writer.schema("S", "jsonschema", "{}"), "/t", "json", Map.of());
            for (int i = 0; i < 50; i++) {
                writer.message(channel, i, new byte[100_000]);
            }
        }
        McapFile file = written();
        assertThat(file.chunks).as("of 11 messages each").isEqualTo(5);
        assertThat(file.messages).hasSize(50).isSortedAccordingTo(Comparator.comparingLong(Message::logNanos));
    }

    @Test
    void failureOfTheOutput_isThrown() throws IOException {
        var full = new OutputStream() {
            private int left = 40;

            @Override
            public void write(int single) throws IOException {
                if (left-- == 0) {
                    throw new IOException("No space left on device");
                }
            }
        };
        var writer = new McapWriter(full, "");
        assertThatThrownBy(() -> {
                    writer.metadata("run", Map.of("seed", "1"));
                    writer.close();
                })
                .isInstanceOf(IOException.class)
                .hasMessage("No space left on device");
    }

    @Test
    void moreChannelsThanIds_areRejected() throws IOException {
        try (var writer = new McapWriter(out, "")) {
            int schema = writer.schema("S", "jsonschema", "{}");
            for (int i = 0; i < 0xFFFF; i++) {
                writer.channel(schema, "/" + i, "json", Map.of());
            }
            assertThatThrownBy(() -> writer.channel(schema, "/more", "json", Map.of()))
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessage("the MCAP file has 65536 channels, expected at most 65535");
        }
        assertThat(written().channels).hasSize(0xFFFF);
    }
}
