package io.troupe.demo;

import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

/** The file {@code run.jsonl}: one JSON object a line, in the order of simulated time; nothing in it depends on the machine's clock. */
final class RunLog implements AutoCloseable {
    private final BufferedWriter writer;

    RunLog(Path file) throws IOException {
        writer = Files.newBufferedWriter(file);
    }

    void write(Json line) throws IOException {
        writer.write(line.toString());
        writer.write('\n');
    }

    @Override
    public void close() throws IOException {
        writer.close();
    }
}
