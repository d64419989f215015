package io.troupe.sim.scenario;

import java.nio.file.Path;

/** Where in a world file something was said; prints as {@code file:line:column}, both counted from 1. */
public record SourcePosition(Path file, int line, int column) {
    @Override
    public String toString() {
        return file + ":" + line + ":" + column;
    }
}
