package io.troupe.sim.scenario;

/**
 * A world or configuration file that cannot be read; the message begins with {@code file:line:column} where one is
 * known, and is cut short in its middle if need be.
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

    /** A problem that can be read: it may quote a word of any length, or list any number of names. */
    static String shortened(String problem) {
        int leftOut = problem.length() - LONGEST_PROBLEM;
        return leftOut <= 0
                ? problem
                : problem.substring(0, LONGEST_PROBLEM / 2) + " .. (" + leftOut + " characters are left out here) .. "
                        + problem.substring(problem.length() - LONGEST_PROBLEM / 2);
    }
}
