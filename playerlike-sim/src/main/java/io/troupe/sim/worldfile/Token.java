package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;

/**
 * A word, number, text or bracket of a file, with its position.
 *
 * @param text as written; of a text in quotes without the quotes
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

    /** The token as shown in messages. */
    String shown() {
        return switch (kind) {
            case END -> "the end of the file";
            case TEXT -> '"' + text + '"';
            default -> "'" + text + "'";
        };
    }
}
