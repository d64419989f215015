package io.troupe.sim.scenario;

/**
 * A word, number, text or bracket of a file, and where it stands.
 *
 * @param text as written; of a text in quotes what stands between them
 */
record Token(Kind kind, String text, SourcePosition where) {
    enum Kind {
        WORD,
        NUMBER,
        TEXT,
        OPEN,
        CLOSE,
        OPEN_TUPLE,
        CLOSE_TUPLE,
        END
    }

    /** For messages: how the reader finds it in the file. */
    String shown() {
        return switch (kind) {
            case END -> "the end of the file";
            case TEXT -> '"' + text + '"';
            default -> "'" + text + "'";
        };
    }
}
