package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;

/**
 * A world or configuration file that cannot be read. The message begins with {@code file:line:column} if the position
 * is known; the middle of a long message is left out.
 */
public final class WorldFileException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private static final int LONGEST_PROBLEM = 2_000;

    public WorldFileException(SourcePosition where, String problem) {
        super(where + ": " + shortened(problem));
    }

    public WorldFileException(String problem) {
        super(shortened(problem));
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
