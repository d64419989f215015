package io.troupe.view.tools;

import java.io.Closeable;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.zip.CRC32;

/**
 * Writes an MCAP file: messages in chunks with checksums, an index of all messages, and a summary with statistics.
 *
 * <p><b>Order.</b> A schema before its channels, a channel before its messages. The same calls write the same bytes.
 *
 * <p><b>Units and shapes.</b> Times are nanoseconds, and need not be in order. Chunks are not compressed: the format
 * knows lz4 and zstd only, which the JDK lacks.
 *
 * <p><b>Errors.</b> After an {@link IOException} the file is no MCAP file.
 *
 * <p><b>Source.</b> The MCAP format specification, version 0.
 */
final class McapWriter implements Closeable {
    static final byte[] MAGIC = {(byte) 0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

    static final int HEADER = 0x01;
    static final int FOOTER = 0x02;
    static final int SCHEMA = 0x03;
    static final int CHANNEL = 0x04;
    static final int MESSAGE = 0x05;
    static final int CHUNK = 0x06;
    static final int MESSAGE_INDEX = 0x07;
    static final int CHUNK_INDEX = 0x08;
    static final int STATISTICS = 0x0B;
    static final int METADATA = 0x0C;
    static final int METADATA_INDEX = 0x0D;
    static final int SUMMARY_OFFSET = 0x0E;
    static final int DATA_END = 0x0F;

    private static final int CHUNK_BYTES = 1 << 20;
    private static final int MOST_IDS = 0xFFFF;
    private static final String NO_COMPRESSION = "";

    private final OutputStream out;
    private final CRC32 checksum = new CRC32(); // of the section that is being written
    private final Bytes record = new Bytes();
    private final Bytes schemas = new Bytes();
    private final Bytes channels = new Bytes();
    private final Bytes chunkIndexes = new Bytes();
    private final Bytes metadataIndexes = new Bytes();
    private final Chunk chunk = new Chunk();
    private final List<Long> channelCounts = new ArrayList<>(); // by channel
    private long offset;
    private int schemaCount;
    private int metadataCount;
    private int chunkCount;
    private long messageCount;
    private long startNanos = Long.MAX_VALUE;
    private long endNanos;
    private boolean closed;

    /** @param library name and version of the program that writes */
    McapWriter(OutputStream out, String library) throws IOException {
        this.out = out;
        write(MAGIC, MAGIC.length);
        record.clear().string("").string(library); // no profile
        writeRecord(HEADER, record);
    }

    /**
     * Adds a schema.
     *
     * @param encoding of {@code data}, for example {@code jsonschema}
     * @return its id
     */
    int schema(String name, String encoding, String data) {
        int id = checkId(++schemaCount, "schemas");
        record.clear().u16(id).string(name).string(encoding).string(data);
        chunk.records.record(SCHEMA, record);
        schemas.record(SCHEMA, record);
        return id;
    }

    /**
     * Adds a channel.
     *
     * @param encoding of its messages, for example {@code json}
     * @return its id
     */
    int channel(int schema, String topic, String encoding, Map<String, String> metadata) {
        int id = checkId(channelCounts.size() + 1, "channels") - 1;
        channelCounts.add(0L);
        record.clear().u16(id).u16(schema).string(topic).string(encoding).map(metadata);
        chunk.records.record(CHANNEL, record);
        channels.record(CHANNEL, record);
        return id;
    }

    private static int checkId(int id, String what) {
        if (id > MOST_IDS) {
            throw new IllegalStateException("the MCAP file has " + id + " " + what + ", expected at most " + MOST_IDS);
        }
        return id;
    }

    void message(int channel, long timeNanos, byte[] data) throws IOException {
        long sequence = channelCounts.get(channel);
        chunk.index(channel, timeNanos);
        record.clear().u16(channel).u32(sequence).u64(timeNanos).u64(timeNanos).bytes(data, data.length);
        chunk.records.record(MESSAGE, record);
        channelCounts.set(channel, sequence + 1);
        messageCount++;
        startNanos = Math.min(startNanos, timeNanos);
        endNanos = Math.max(endNanos, timeNanos);
        if (chunk.records.size >= CHUNK_BYTES) {
            writeChunk();
        }
    }

    /** Adds names and values that describe the whole file. */
    void metadata(String name, Map<String, String> values) throws IOException {
        writeChunk();
        long start = offset;
        record.clear().string(name).map(values);
        writeRecord(METADATA, record);
        metadataCount++;
        record.clear().u64(start).u64(offset - start).string(name);
        metadataIndexes.record(METADATA_INDEX, record);
    }

    /** Writes what is left, the summary and the end, and closes the output. */
    @Override
    public void close() throws IOException {
        if (closed) {
            return;
        }
        closed = true;
        try (out) {
            writeChunk();
            record.clear().u32(checksum.getValue());
            writeRecord(DATA_END, record);
            writeSummary();
            write(MAGIC, MAGIC.length);
        }
    }

    private void writeChunk() throws IOException {
        if (chunk.records.size == 0) {
            return;
        }
        long start = offset;
        Bytes records = chunk.records;
        record.clear()
                .u64(chunk.startNanos())
                .u64(chunk.endNanos)
                .u64(records.size)
                .u32(records.checksum())
                .string(NO_COMPRESSION)
                .u64(records.size)
                .bytes(records.content, records.size);
        writeRecord(CHUNK, record);
        long length = offset - start;
        Map<Integer, Long> indexOffsets = new TreeMap<>();
        long indexStart = offset;
        for (var channel : chunk.indexes.entrySet()) {
            indexOffsets.put(channel.getKey(), offset);
            Bytes index = channel.getValue();
            record.clear().u16(channel.getKey()).u32(index.size).bytes(index.content, index.size);
            writeRecord(MESSAGE_INDEX, record);
        }
        record.clear()
                .u64(chunk.startNanos())
                .u64(chunk.endNanos)
                .u64(start)
                .u64(length)
                .counts(indexOffsets)
                .u64(offset - indexStart)
                .string(NO_COMPRESSION)
                .u64(records.size)
                .u64(records.size);
        chunkIndexes.record(CHUNK_INDEX, record);
        chunkCount++;
        chunk.clear();
    }

    private void writeSummary() throws IOException {
        Map<Integer, Long> counts = new TreeMap<>();
        for (int channel = 0; channel < channelCounts.size(); channel++) {
            counts.put(channel, channelCounts.get(channel));
        }
        record.clear()
                .u64(messageCount)
                .u16(schemaCount)
                .u32(channelCounts.size())
                .u32(0) // attachments
                .u32(metadataCount)
                .u32(chunkCount)
                .u64(messageCount == 0 ? 0 : startNanos)
                .u64(endNanos)
                .counts(counts);
        var statistics = new Bytes();
        statistics.record(STATISTICS, record);
        checksum.reset();
        long summaryStart = offset;
        var offsets = new Bytes();
        writeGroup(SCHEMA, schemas, offsets);
        writeGroup(CHANNEL, channels, offsets);
        writeGroup(STATISTICS, statistics, offsets);
        writeGroup(METADATA_INDEX, metadataIndexes, offsets);
        writeGroup(CHUNK_INDEX, chunkIndexes, offsets);
        long offsetsStart = offset;
        write(offsets.content, offsets.size);
        var footer = new Bytes();
        footer.u8(FOOTER).u64(2 * Long.BYTES + Integer.BYTES).u64(summaryStart).u64(offsetsStart);
        write(footer.content, footer.size);
        record.clear().u32(checksum.getValue());
        write(record.content, record.size);
    }

    private void writeGroup(int opcode, Bytes group, Bytes offsets) throws IOException {
        if (group.size > 0) {
            record.clear().u8(opcode).u64(offset).u64(group.size);
            offsets.record(SUMMARY_OFFSET, record);
            write(group.content, group.size);
        }
    }

    private void writeRecord(int opcode, Bytes content) throws IOException {
        var head = new Bytes();
        head.u8(opcode).u64(content.size);
        write(head.content, head.size);
        write(content.content, content.size);
    }

    private void write(byte[] bytes, int length) throws IOException {
        out.write(bytes, 0, length);
        checksum.update(bytes, 0, length);
        offset += length;
    }

    /** The records of the chunk that has not been written yet. */
    private static final class Chunk {
        final Bytes records = new Bytes();
        /** For each channel, the time and position of its messages. */
        final Map<Integer, Bytes> indexes = new TreeMap<>();

        private long firstNanos = Long.MAX_VALUE;
        long endNanos;

        void index(int channel, long timeNanos) {
            indexes.computeIfAbsent(channel, each -> new Bytes()).u64(timeNanos).u64(records.size);
            firstNanos = Math.min(firstNanos, timeNanos);
            endNanos = Math.max(endNanos, timeNanos);
        }

        long startNanos() {
            return indexes.isEmpty() ? 0 : firstNanos;
        }

        void clear() {
            records.clear();
            indexes.clear();
            firstNanos = Long.MAX_VALUE;
            endNanos = 0;
        }
    }

    /** A growing array of bytes, with the serialization of the format. */
    private static final class Bytes {
        byte[] content = new byte[256];
        int size;

        Bytes clear() {
            size = 0;
            return this;
        }

        Bytes u8(int value) {
            return little(value, 1);
        }

        Bytes u16(int value) {
            return little(value, Short.BYTES);
        }

        Bytes u32(long value) {
            return little(value, Integer.BYTES);
        }

        Bytes u64(long value) {
            return little(value, Long.BYTES);
        }

        private Bytes little(long value, int bytes) {
            fit(bytes);
            for (int i = 0; i < bytes; i++) {
                content[size++] = (byte) (value >>> 8 * i);
            }
            return this;
        }

        Bytes string(String text) {
            byte[] utf8 = text.getBytes(StandardCharsets.UTF_8);
            return u32(utf8.length).bytes(utf8, utf8.length);
        }

        Bytes bytes(byte[] bytes, int length) {
            fit(length);
            System.arraycopy(bytes, 0, content, size, length);
            size += length;
            return this;
        }

        /** In the order of the keys. */
        Bytes map(Map<String, String> entries) {
            var all = new Bytes();
            new TreeMap<>(entries).forEach((key, value) -> all.string(key).string(value));
            return u32(all.size).bytes(all.content, all.size);
        }

        Bytes counts(Map<Integer, Long> entries) {
            u32((long) entries.size() * (Short.BYTES + Long.BYTES));
            entries.forEach((key, value) -> u16(key).u64(value));
            return this;
        }

        void record(int opcode, Bytes record) {
            u8(opcode).u64(record.size).bytes(record.content, record.size);
        }

        long checksum() {
            var crc = new CRC32();
            crc.update(content, 0, size);
            return crc.getValue();
        }

        private void fit(int more) {
            if (size + more > content.length) {
                content = Arrays.copyOf(content, Math.max(size + more, 2 * content.length));
            }
        }
    }
}
