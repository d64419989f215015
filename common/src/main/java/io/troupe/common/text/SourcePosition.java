package io.troupe.common.text;

import java.nio.file.Path;

/** A position in a world file; prints as {@code file:line:column}, line and column counted from 1. */
public record SourcePosition(Path file, int line, int column) {
    @Override
    public String toString() {
        return file + ":" + line + ":" + column;
    }
}
