package io.troupe.demo;

import io.troupe.demo.terminal.FileProblems;
import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;

/**
 * The file {@code run.jsonl}: one JSON object per line, in the order of simulated time. No value depends on the wall
 * clock. The format is described in {@code docs/run-log.md}.
 *
 * <p><b>Errors.</b> A failed write does not end the run. {@link #close} throws the first failure, with the name of the
 * file.
 */
final class RunLog implements AutoCloseable {
    /**
     * Name and version of the format. The version is incremented when readers of the previous one would misread the
     * file.
     */
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

    /** The first line of the file. */
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
        return new IOException(FileProblems.message(file, e), e);
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
