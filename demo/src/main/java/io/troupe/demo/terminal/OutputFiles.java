package io.troupe.demo.terminal;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;

/** Writes results whose errors name the file: that of a full disk does not by itself. */
public final class OutputFiles {
    private OutputFiles() {}

    /** A whole text; if it cannot be written to its end, nothing of it stays. */
    public static void write(Path file, CharSequence text) throws IOException {
        write(file, text.toString().getBytes(StandardCharsets.UTF_8));
    }

    /** Whole contents; if they cannot be written to their end, nothing of them stays. */
    public static void write(Path file, byte[] content) throws IOException {
        boolean opened = false;
        try (var stream = Files.newOutputStream(file)) {
            opened = true;
            stream.write(content);
        } catch (IOException e) {
            if (opened && Files.isRegularFile(file)) {
                Files.deleteIfExists(file);
            }
            throw new IOException(FileProblems.words(file, e), e);
        }
    }
}
