package io.troupe.sim.scenario;

import io.troupe.sim.scenario.Token.Kind;
import java.nio.file.Path;
import java.util.List;

/** A place in the tokens of one file. */
final class TokenCursor {
    private final Path file;
    private final List<Token> tokens;
    private int next;

    TokenCursor(Path file, List<Token> tokens) {
        this.file = file;
        this.tokens = tokens;
    }

    Path file() {
        return file;
    }

    boolean at(Kind kind) {
        return peek(0).kind() == kind;
    }

    /** The token {@code ahead} places on; beyond the end the end. */
    Token peek(int ahead) {
        return tokens.get(Math.min(next + ahead, tokens.size() - 1));
    }

    Token next() {
        Token token = peek(0);
        next++;
        return token;
    }

    /** The next token if it is of this kind, else an error that says what was expected. */
    Token expect(Kind kind, String expected) {
        require(kind, expected);
        return next();
    }

    /** The same, and stays before it. */
    void require(Kind kind, String expected) {
        if (!at(kind)) {
            throw new WorldFileException(peek(0).where(), "expected " + expected + ", found " + peek(0).shown());
        }
    }
}
