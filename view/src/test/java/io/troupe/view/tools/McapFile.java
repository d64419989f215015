package io.troupe.view.tools;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.zip.CRC32;

/**
 * An MCAP file that has been read from end to end. Every record, length, checksum, position and count is checked, those
 * of the indexes against the records that they point to.
 */
final class McapFile {
    /** A message, as it is in the file. */
    record Message(int channel, long sequence, long logNanos, long publishNanos, String data) {}

    record Schema(String name, String encoding, String data) {}

    record Channel(int schema, String topic, String encoding, Map<String, String> metadata) {}

    final Map<Integer, Schema> schemas = new TreeMap<>();
    final Map<Integer, Channel> channels = new TreeMap<>();
    final Map<String, Map<String, String>> metadata = new LinkedHashMap<>();
    final List<Message> messages = new ArrayList<>();
    final String library;
    int chunks;

    private final ByteBuffer file;
    /** By position of the chunk: the record, and the message indexes after it. */
    private final Map<Long, ChunkRecord> chunkRecords = new TreeMap<>();

    private final Map<Integer, Long> sequences = new TreeMap<>(); // number of messages so far, by channel
    private final Map<Long, Row> metadataRecords = new TreeMap<>();

    /** A record with its position, opcode and content. */
    private record Row(long start, int opcode, ByteBuffer content) {
        long length() {
            return 9 + content.capacity();
        }
    }

    private static final class ChunkRecord {
        long startNanos;
        long endNanos;
        long length;
        long uncompressedSize;
        final Map<Long, Message> messages = new TreeMap<>(); // by position in the chunk
        final Map<Integer, Long> indexes = new TreeMap<>(); // by channel: position in the file
        long indexLength;
    }

    McapFile(byte[] bytes) {
        file = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN);
        assertThat(magic()).isEqualTo(McapWriter.MAGIC);
        Row header = next();
        assertThat(header.opcode).isEqualTo(McapWriter.HEADER);
        assertThat(string(header.content)).as("profile").isEmpty();
        library = string(header.content);
        requireEnd(header);
        readData();
        readSummary();
        assertThat(magic()).isEqualTo(McapWriter.MAGIC);
        assertThat(file.hasRemaining()).isFalse();
    }

    /** The texts of a topic, in the order of the file. */
    List<String> texts(String topic) {
        return messages.stream()
                .filter(message -> channel(message).topic.equals(topic))
                .map(Message::data)
                .toList();
    }

    Channel channel(Message message) {
        Channel channel = channels.get(message.channel);
        assertThat(channel).as("channel of " + message).isNotNull();
        return channel;
    }

    private byte[] magic() {
        byte[] magic = new byte[8];
        file.get(magic);
        return magic;
    }

    private Row next() {
        return next(file);
    }

    private static Row next(ByteBuffer from) {
        long start = from.position();
        int opcode = from.get();
        int length = Math.toIntExact(from.getLong());
        var content = from.slice(from.position(), length).order(ByteOrder.LITTLE_ENDIAN);
        from.position(from.position() + length);
        return new Row(start, opcode, content);
    }

    private static void requireEnd(Row row) {
        assertThat(row.content.hasRemaining())
                .as("bytes after the last field of record " + row.opcode)
                .isFalse();
    }

    private static String string(ByteBuffer from) {
        byte[] utf8 = new byte[from.getInt()];
        from.get(utf8);
        return new String(utf8, StandardCharsets.UTF_8);
    }

    private static Map<String, String> map(ByteBuffer from) {
        ByteBuffer entries = part(from, from.getInt());
        Map<String, String> map = new LinkedHashMap<>();
        while (entries.hasRemaining()) {
            String key = string(entries);
            assertThat(map.put(key, string(entries)))
                    .as("second value of " + key)
                    .isNull();
        }
        return map;
    }

    private static Map<Integer, Long> counts(ByteBuffer from) {
        ByteBuffer entries = part(from, from.getInt());
        Map<Integer, Long> map = new TreeMap<>();
        while (entries.hasRemaining()) {
            map.put(Short.toUnsignedInt(entries.getShort()), entries.getLong());
        }
        return map;
    }

    private static ByteBuffer part(ByteBuffer from, int length) {
        var part = from.slice(from.position(), length).order(ByteOrder.LITTLE_ENDIAN);
        from.position(from.position() + length);
        return part;
    }

    private static long checksum(ByteBuffer bytes) {
        var crc = new CRC32();
        crc.update(bytes);
        return crc.getValue();
    }

    private ByteBuffer between(long start, long end) {
        return file.slice((int) start, (int) (end - start));
    }

    private static long u32(ByteBuffer from) {
        return Integer.toUnsignedLong(from.getInt());
    }

    // ---- data

    private void readData() {
        ChunkRecord chunk = new ChunkRecord();
        for (Row row = next(); ; row = next()) {
            switch (row.opcode) {
                case McapWriter.CHUNK -> {
                    chunk = readChunk(row);
                    chunkRecords.put(row.start, chunk);
                }
                case McapWriter.MESSAGE_INDEX -> readIndex(row, chunk);
                case McapWriter.METADATA -> {
                    metadataRecords.put(row.start, row);
                    metadata.put(string(row.content), map(row.content));
                    requireEnd(row);
                }
                case McapWriter.DATA_END -> {
                    assertThat(u32(row.content)).as("checksum of the data").isEqualTo(checksum(between(0, row.start)));
                    requireEnd(row);
                    chunks = chunkRecords.size();
                    return;
                }
                default -> throw new AssertionError("record " + row.opcode + " among the data");
            }
        }
    }

    private ChunkRecord readChunk(Row row) {
        var chunk = new ChunkRecord();
        ByteBuffer from = row.content;
        chunk.length = row.length();
        chunk.startNanos = from.getLong();
        chunk.endNanos = from.getLong();
        chunk.uncompressedSize = from.getLong();
        long crc = u32(from);
        assertThat(string(from)).as("compression").isEmpty();
        ByteBuffer records = part(from, Math.toIntExact(from.getLong()));
        requireEnd(row);
        assertThat(records.capacity()).isEqualTo(Math.toIntExact(chunk.uncompressedSize));
        assertThat(crc).as("checksum of a chunk").isEqualTo(checksum(records.duplicate()));
        while (records.hasRemaining()) {
            readInChunk(next(records), chunk);
        }
        long start = chunk.messages.values().stream()
                .mapToLong(Message::logNanos)
                .min()
                .orElse(0);
        long end = chunk.messages.values().stream()
                .mapToLong(Message::logNanos)
                .max()
                .orElse(0);
        assertThat(List.of(chunk.startNanos, chunk.endNanos))
                .as("times of a chunk")
                .isEqualTo(List.of(start, end));
        return chunk;
    }

    private void readInChunk(Row row, ChunkRecord chunk) {
        ByteBuffer from = row.content;
        switch (row.opcode) {
            case McapWriter.SCHEMA -> {
                int id = Short.toUnsignedInt(from.getShort());
                assertThat(schemas.put(id, schema(from)))
                        .as("second schema " + id)
                        .isNull();
                assertThat(id).isPositive();
            }
            case McapWriter.CHANNEL -> {
                int id = Short.toUnsignedInt(from.getShort());
                Channel channel = channel(from);
                assertThat(schemas).containsKey(channel.schema);
                assertThat(channels.put(id, channel)).as("second channel " + id).isNull();
            }
            case McapWriter.MESSAGE -> {
                int channel = Short.toUnsignedInt(from.getShort());
                long sequence = u32(from);
                long logNanos = from.getLong();
                long publishNanos = from.getLong();
                String data = StandardCharsets.UTF_8
                        .decode(part(from, from.remaining()))
                        .toString();
                var message = new Message(channel, sequence, logNanos, publishNanos, data);
                assertThat(channels).as("channels before a message").containsKey(channel);
                assertThat(sequence)
                        .as("sequence of " + channel(message).topic)
                        .isEqualTo(sequences.merge(channel, 1L, Long::sum) - 1);
                messages.add(message);
                chunk.messages.put(row.start, message);
            }
            default -> throw new AssertionError("record " + row.opcode + " in a chunk");
        }
        requireEnd(row);
    }

    private static Schema schema(ByteBuffer from) {
        return new Schema(string(from), string(from), string(from));
    }

    private static Channel channel(ByteBuffer from) {
        int schema = Short.toUnsignedInt(from.getShort());
        return new Channel(schema, string(from), string(from), map(from));
    }

    private void readIndex(Row row, ChunkRecord chunk) {
        int channel = Short.toUnsignedInt(row.content.getShort());
        ByteBuffer entries = part(row.content, row.content.getInt());
        requireEnd(row);
        long expected = chunk.messages.values().stream()
                .filter(each -> each.channel == channel)
                .count();
        assertThat(entries.remaining()).as("entries of a message index").isEqualTo((int) expected * 16);
        while (entries.hasRemaining()) {
            long timeNanos = entries.getLong();
            Message message = chunk.messages.get(entries.getLong());
            assertThat(message).as("message at an indexed position").isNotNull();
            assertThat(List.of((long) message.channel, message.logNanos)).isEqualTo(List.of((long) channel, timeNanos));
        }
        assertThat(chunk.indexes.put(channel, row.start))
                .as("second index of a channel")
                .isNull();
        chunk.indexLength += row.length();
    }

    // ---- summary

    private void readSummary() {
        long summaryStart = file.position();
        Map<Integer, long[]> groups = new LinkedHashMap<>(); // opcode: start and end
        Map<Integer, Schema> schemasAgain = new TreeMap<>();
        Map<Integer, Channel> channelsAgain = new TreeMap<>();
        int indexedChunks = 0;
        int indexedMetadata = 0;
        Row row = next();
        for (; row.opcode != McapWriter.SUMMARY_OFFSET; row = next()) {
            long start = row.start;
            ByteBuffer from = row.content;
            switch (row.opcode) {
                case McapWriter.SCHEMA -> schemasAgain.put(Short.toUnsignedInt(from.getShort()), schema(from));
                case McapWriter.CHANNEL -> channelsAgain.put(Short.toUnsignedInt(from.getShort()), channel(from));
                case McapWriter.STATISTICS -> readStatistics(from);
                case McapWriter.METADATA_INDEX -> {
                    Row record = metadataRecords.get(from.getLong());
                    assertThat(record).as("metadata at an indexed position").isNotNull();
                    assertThat(from.getLong()).isEqualTo(record.length());
                    assertThat(string(from)).isEqualTo(string(record.content.rewind()));
                    indexedMetadata++;
                }
                case McapWriter.CHUNK_INDEX -> {
                    readChunkIndex(from);
                    indexedChunks++;
                }
                default -> throw new AssertionError("record " + row.opcode + " in the summary");
            }
            requireEnd(row);
            long[] group = groups.computeIfAbsent(row.opcode, each -> new long[] {start, start});
            assertThat(group[1]).as("end of the group of record " + row.opcode).isEqualTo(start);
            group[1] = start + row.length();
        }
        assertThat(schemasAgain).isEqualTo(schemas);
        assertThat(channelsAgain).isEqualTo(channels);
        assertThat(List.of(indexedChunks, indexedMetadata))
                .as("indexed chunks and metadata")
                .isEqualTo(List.of(chunkRecords.size(), metadataRecords.size()));
        long offsetStart = row.start;
        for (; row.opcode == McapWriter.SUMMARY_OFFSET; row = next()) {
            long[] group = groups.remove((int) row.content.get());
            assertThat(group).as("group of a summary offset").isNotNull();
            assertThat(row.content.getLong()).isEqualTo(group[0]);
            assertThat(row.content.getLong()).isEqualTo(group[1] - group[0]);
            requireEnd(row);
        }
        assertThat(groups).as("groups without summary offset").isEmpty();
        assertThat(row.opcode).isEqualTo(McapWriter.FOOTER);
        assertThat(row.content.getLong()).as("start of the summary").isEqualTo(summaryStart);
        assertThat(row.content.getLong()).as("start of the summary offsets").isEqualTo(offsetStart);
        assertThat(u32(row.content))
                .as("checksum of the summary")
                .isEqualTo(checksum(between(summaryStart, row.start + row.length() - 4)));
        requireEnd(row);
    }

    private void readStatistics(ByteBuffer from) {
        assertThat(from.getLong()).as("messages").isEqualTo(messages.size());
        assertThat((int) from.getShort()).as("schemas").isEqualTo(schemas.size());
        assertThat(from.getInt()).as("channels").isEqualTo(channels.size());
        assertThat(from.getInt()).as("attachments").isZero();
        assertThat(from.getInt()).as("metadata").isEqualTo(metadataRecords.size());
        assertThat(from.getInt()).as("chunks").isEqualTo(chunkRecords.size());
        assertThat(from.getLong())
                .as("start")
                .isEqualTo(messages.stream().mapToLong(Message::logNanos).min().orElse(0));
        assertThat(from.getLong())
                .as("end")
                .isEqualTo(messages.stream().mapToLong(Message::logNanos).max().orElse(0));
        Map<Integer, Long> expected = new TreeMap<>();
        channels.keySet().forEach(channel -> expected.put(channel, 0L));
        messages.forEach(message -> expected.merge(message.channel, 1L, Long::sum));
        assertThat(counts(from)).as("messages by channel").isEqualTo(expected);
    }

    private void readChunkIndex(ByteBuffer from) {
        long startNanos = from.getLong();
        long endNanos = from.getLong();
        ChunkRecord chunk = chunkRecords.get(from.getLong());
        assertThat(chunk).as("chunk at an indexed position").isNotNull();
        assertThat(List.of(startNanos, endNanos)).isEqualTo(List.of(chunk.startNanos, chunk.endNanos));
        assertThat(from.getLong()).as("length of the chunk").isEqualTo(chunk.length);
        assertThat(counts(from)).as("positions of message indexes").isEqualTo(chunk.indexes);
        assertThat(from.getLong()).as("length of the message indexes").isEqualTo(chunk.indexLength);
        assertThat(string(from)).as("compression").isEmpty();
        assertThat(from.getLong()).isEqualTo(chunk.uncompressedSize);
        assertThat(from.getLong()).isEqualTo(chunk.uncompressedSize);
    }
}
