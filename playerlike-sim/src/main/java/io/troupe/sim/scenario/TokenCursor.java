package io.troupe.sim.scenario;

import io.troupe.sim.scenario.Token.Kind;
import java.nio.file.Path;
import java.util.List;

/** A read position in the tokens of one file. */
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

    /** The token {@code ahead} positions further on; the end token beyond the end. */
    Token peek(int ahead) {
        return tokens.get(Math.min(next + ahead, tokens.size() - 1));
    }

    Token next() {
        Token token = peek(0);
        next++;
        return token;
    }

    /** Takes the next token if it is of this kind, else throws an error with what was expected. */
    Token expect(Kind kind, String expected) {
        require(kind, expected);
        return next();
    }

    /** As {@link #expect}, without taking the token. */
    void require(Kind kind, String expected) {
        if (!at(kind)) {
            throw new WorldFileException(peek(0).where(), "expected " + expected + ", found " + peek(0).shown());
        }
    }
}
