package io.troupe.demo;

import io.troupe.demo.terminal.FileProblems;
import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;

/**
 * The file {@code run.jsonl}: one JSON object a line, in the order of simulated time; nothing in it depends on the
 * machine's clock. {@code docs/run-log.md} describes it.
 *
 * <p><b>Errors.</b> A line that cannot be written does not end the run: {@link #close} throws what has happened, and
 * names the file.
 */
final class RunLog implements AutoCloseable {
    /** The name and version of the format; the version rises when a reader of the old one would misread the new one. */
    static final String FORMAT = "troupe-run";

    static final int VERSION = 1;

    private final Path file;
    private final BufferedWriter writer;
    private @Nullable IOException failure;

    RunLog(Path file) throws IOException {
        this.file = file;
        try {
            writer = Files.newBufferedWriter(file);
        } catch (IOException e) {
            throw named(e);
        }
    }

    /** The first line. */
    static Json header() {
        return Json.line(0, "header")
                .put("format", FORMAT)
                .put("version", VERSION)
                .put("program", Main.PROGRAM);
    }

    void write(Json line) {
        if (failure != null) {
            return;
        }
        try {
            writer.write(line.toString());
            writer.write('\n');
        } catch (IOException e) {
            failure = e;
        }
    }

    private IOException named(IOException e) {
        return new IOException(FileProblems.words(file, e), e);
    }

    @Override
    public void close() throws IOException {
        try {
            writer.close();
        } catch (IOException e) {
            failure = failure == null ? e : failure;
        }
        if (failure != null) {
            throw named(failure);
        }
    }
}
