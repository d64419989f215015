package io.troupe.demo.terminal;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

/** Writes results whose errors name the file: that of a full disk does not by itself. */
public final class OutputFiles {
    private OutputFiles() {}

    /** A whole text; if it cannot be written to its end, nothing of it stays. */
    public static void write(Path file, CharSequence text) throws IOException {
        boolean opened = false;
        try (var writer = Files.newBufferedWriter(file)) {
            opened = true;
            writer.append(text);
        } catch (IOException e) {
            if (opened && Files.isRegularFile(file)) {
                Files.deleteIfExists(file);
            }
            throw new IOException(FileProblems.words(file, e), e);
        }
    }
}
