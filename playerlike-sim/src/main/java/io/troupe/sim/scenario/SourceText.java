package io.troupe.sim.scenario;

import java.io.IOException;
import java.nio.charset.CharacterCodingException;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;

/** Finds and reads files that a user or another file named. */
final class SourceText {
    private static final long MOST_BYTES = 16_000_000;

    private SourceText() {}

    /**
     * The text of a file.
     *
     * @param asker where the file is named; null if the user named it
     */
    static String read(Path file, @Nullable SourcePosition asker) {
        if (!Files.isRegularFile(file)) {
            throw problem(asker, Files.exists(file) ? file + " is not a file" : "there is no file " + file);
        }
        try {
            if (Files.size(file) > MOST_BYTES) {
                throw problem(asker, file + " is larger than " + MOST_BYTES + " bytes");
            }
            String text = Files.readString(file);
            return text.startsWith("\uFEFF") ? text.substring(1) : text;
        } catch (CharacterCodingException e) {
            throw problem(asker, file + " is not UTF-8 text");
        } catch (IOException e) {
            throw problem(asker, "cannot read " + file + ": " + e);
        }
    }

    /** The file that another one names, relative to that other one. */
    static Path sibling(Path file, String name, SourcePosition asker) {
        try {
            return file.resolveSibling(name).normalize();
        } catch (InvalidPathException e) {
            throw new WorldFileException(asker, "\"" + name + "\" is not a file name: " + e.getReason());
        }
    }

    private static WorldFileException problem(@Nullable SourcePosition asker, String problem) {
        return asker == null ? new WorldFileException(problem) : new WorldFileException(asker, problem);
    }
}
