package io.troupe.sim.scenario;

/** A world or configuration file that cannot be read; the message begins with {@code file:line:column} where one is known. */
public final class WorldFileException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public WorldFileException(SourcePosition where, String problem) {
        super(where + ": " + problem);
    }

    public WorldFileException(String problem) {
        super(problem);
    }
}
