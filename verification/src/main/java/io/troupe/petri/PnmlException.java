package io.troupe.petri;

import org.jspecify.annotations.Nullable;

/**
 * A PNML file that cannot be read. The message is {@code file:line: reason}; the line is missing if the error has none.
 */
public final class PnmlException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    PnmlException(String source, int line, String reason, @Nullable Throwable cause) {
        super(source + (line > 0 ? ":" + line : "") + ": " + reason, cause);
    }
}
