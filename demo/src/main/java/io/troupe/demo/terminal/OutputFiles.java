package io.troupe.demo.terminal;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;

/** Writes result files. Every error names the file, which the system's message for a full disk does not. */
public final class OutputFiles {
    private OutputFiles() {}

    /** Writes a text. After an error no partial file remains. */
    public static void write(Path file, CharSequence text) throws IOException {
        write(file, text.toString().getBytes(StandardCharsets.UTF_8));
    }

    /** Writes bytes. After an error no partial file remains. */
    public static void write(Path file, byte[] content) throws IOException {
        boolean opened = false;
        try (var stream = Files.newOutputStream(file)) {
            opened = true;
            stream.write(content);
        } catch (IOException e) {
            if (opened && Files.isRegularFile(file)) {
                Files.deleteIfExists(file);
            }
            throw new IOException(FileProblems.message(file, e), e);
        }
    }
}
