package io.troupe.common.text;

import java.nio.file.Path;

/**
 * A position in a text; prints as {@code file:line:column}.
 *
 * @param file the file, or the name of a text that is no file
 * @param line counted from 1
 * @param column counted from 1
 */
public record SourcePosition(Path file, int line, int column) {
    @Override
    public String toString() {
        return file + ":" + line + ":" + column;
    }
}
