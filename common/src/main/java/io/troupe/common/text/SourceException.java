package io.troupe.common.text;

import java.util.Optional;
import org.jspecify.annotations.Nullable;

/**
 * Thrown for a text that cannot be read: a world, a table, an application. The message is {@code file:line:column:
 * problem}, or the problem alone if it has no position. Each language has a subclass.
 */
public abstract class SourceException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final transient @Nullable SourcePosition where;

    protected SourceException(SourcePosition where, String problem) {
        super(where + ": " + problem);
        this.where = where;
    }

    protected SourceException(String problem, @Nullable Throwable cause) {
        super(problem, cause);
        this.where = null;
    }

    /** The position of the problem; empty if it concerns a whole file, such as one that cannot be opened. */
    public Optional<SourcePosition> where() {
        return Optional.ofNullable(where);
    }
}
