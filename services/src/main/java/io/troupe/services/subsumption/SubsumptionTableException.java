package io.troupe.services.subsumption;

/**
 * Thrown if a table file cannot be read. The message begins with {@code file:line:column} (with {@code file} if the
 * file cannot be opened) and describes what was expected.
 */
public final class SubsumptionTableException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final int line;
    private final int column;

    SubsumptionTableException(String file, int line, int column, String problem) {
        super(file + ":" + line + ":" + column + ": " + problem);
        this.line = line;
        this.column = column;
    }

    SubsumptionTableException(String problem, Throwable cause) {
        super(problem, cause);
        this.line = 0;
        this.column = 0;
    }

    /** Counted from 1; 0 if the file could not be opened. */
    public int line() {
        return line;
    }

    /** Counted from 1; 0 if the file could not be opened. */
    public int column() {
        return column;
    }
}
