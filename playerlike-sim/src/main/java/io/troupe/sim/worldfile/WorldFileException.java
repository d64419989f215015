package io.troupe.sim.worldfile;

import io.troupe.common.text.SourceException;
import io.troupe.common.text.SourcePosition;

/** Thrown for a world or configuration file that cannot be read. The middle of a long message is left out. */
public final class WorldFileException extends SourceException {
    private static final long serialVersionUID = 1L;

    private static final int LONGEST_PROBLEM = 2_000;

    private final String problem;

    public WorldFileException(SourcePosition where, String problem) {
        super(where, shortened(problem));
        this.problem = shortened(problem);
    }

    public WorldFileException(String problem) {
        super(shortened(problem), null);
        this.problem = shortened(problem);
    }

    /** The message without the position. */
    String problem() {
        return problem;
    }

    /** Limits a problem to a readable length: it may quote a word of any length, or list any number of names. */
    static String shortened(String problem) {
        int leftOut = problem.length() - LONGEST_PROBLEM;
        return leftOut <= 0
                ? problem
                : problem.substring(0, LONGEST_PROBLEM / 2) + " .. (" + leftOut + " characters are left out here) .. "
                        + problem.substring(problem.length() - LONGEST_PROBLEM / 2);
    }
}
