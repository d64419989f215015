package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;

/** A part of a file that was left out or changed; prints as {@code file:line:column: problem}. */
public record WorldFileWarning(SourcePosition where, String problem) {
    public WorldFileWarning {
        problem = WorldFileException.shortened(problem);
    }

    @Override
    public String toString() {
        return where + ": " + problem;
    }
}
