package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.worldfile.Lexer.Kind;
import io.troupe.sim.worldfile.Lexer.Token;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * Parses the grammar that world and configuration files share into a tree. It knows no entities or properties.
 *
 * <p>{@code include "file"} is relative to the including file or else, as in Stage, to the first file, or one of those
 * that come with us; {@code define new old ( .. )} defines a macro, which may be based on another macro.
 */
final class EntityParser {
    private static final int DEEPEST_NESTING = 64;
    private static final int MOST_FILES = 1000;
    private static final int HIGHEST_INDEX = 1_000_000;

    /**
     * Limit of inherited properties. Each macro has a separate table of those that it inherits; real worlds are far
     * below. Instances share the table of their macro.
     */
    private static final long MOST_INHERITED = 1_000_000;

    /** Limit of entities in macros. All macros are checked, used or not, with the entities that they contain. */
    private static final long MOST_MACRO_ENTITIES = 1_000_000;

    private final Map<String, Entity> macros = new LinkedHashMap<>();
    private final Map<String, SourcePosition> macroNames = new LinkedHashMap<>();
    private final List<Path> open = new ArrayList<>();
    private final Entity.Builder root;
    private final Path mainFile;
    private final Diagnostics diagnostics;
    private int filesRead;
    private long tokensRead;
    private long inherited;
    private long macroEntities;
    private long macroValues;

    private EntityParser(String rootType, Path file, Diagnostics diagnostics) {
        root = new Entity.Builder(rootType, null, new SourcePosition(file, 1, 1), diagnostics);
        mainFile = file;
        this.diagnostics = diagnostics;
    }

    /**
     * Parses a file.
     *
     * @param rootType the entity type that stands for the file itself
     * @param namedAt position where the file is named; null if the user named it
     */
    static Document parse(String rootType, Path file, @Nullable SourcePosition namedAt, Diagnostics diagnostics) {
        var parser = new EntityParser(rootType, file, diagnostics);
        parser.text(SourceText.read(file, namedAt), file);
        return new Document(parser.root.build(), parser.macros);
    }

    /** Parses a text as if it were read from {@code file}, which need not exist. */
    static Document parseText(String rootType, String text, Path file, Diagnostics diagnostics) {
        var parser = new EntityParser(rootType, file, diagnostics);
        parser.text(text, file);
        return new Document(parser.root.build(), parser.macros);
    }

    private void text(String text, Path file) {
        open.add(file);
        List<Token> tokens = Lexer.tokens(text, file);
        tokensRead += tokens.size();
        if (tokensRead > Lexer.MOST_TOKENS) {
            throw new WorldFileException(
                    tokens.getFirst().where(),
                    "with this file more than " + Lexer.MOST_TOKENS + " words, numbers and brackets have been read");
        }
        var cursor = new TokenCursor(file, tokens);
        while (!cursor.at(Kind.END)) {
            Token word = cursor.expect(Kind.WORD, "a property, an entity, include or define");
            switch (word.text()) {
                case "include" -> include(cursor);
                case "define" -> define(cursor);
                default -> statement(word, cursor, root, 0);
            }
        }
        open.removeLast();
    }

    private void guardIncludes(Path file, SourcePosition namedAt) {
        Path absolute = file.toAbsolutePath().normalize();
        if (open.stream().anyMatch(other -> other.toAbsolutePath().normalize().equals(absolute))) {
            String chain = Stream.concat(open.stream(), Stream.of(file))
                    .map(path -> String.valueOf(path.getFileName()))
                    .collect(Collectors.joining(" -> "));
            throw new WorldFileException(namedAt, "a file cannot include itself: " + chain);
        }
        if (++filesRead > MOST_FILES) {
            throw new WorldFileException(namedAt, "more than " + MOST_FILES + " files are included");
        }
    }

    private void include(TokenCursor cursor) {
        Token name = cursor.expect(Kind.TEXT, "a file name in double quotes after include");
        var included = SourceText.include(cursor.file(), mainFile, name.text(), name.where(), diagnostics);
        guardIncludes(included.file(), name.where());
        text(included.text(), included.file());
    }

    private void define(TokenCursor cursor) {
        Token name = cursor.expect(Kind.WORD, "the new name after define");
        Token base = cursor.expect(Kind.WORD, "an entity type or macro after define " + name.text());
        cursor.require(Kind.OPEN, "'(' after define " + name.text() + " " + base.text());
        if (Vocabulary.isType(name.text())) {
            diagnostics.warn(
                    name.where(),
                    "macro \"" + name.text() + "\" has the name of an entity type: from here on \"" + name.text()
                            + "\" is the macro, as in Stage"
                            + (name.text().equals("block") ? ", also where the outline of a model is meant" : ""));
        }
        SourcePosition earlier = macroNames.putIfAbsent(name.text(), name.where());
        if (earlier != null && !earlier.equals(name.where())) {
            diagnostics.warn(
                    name.where(),
                    "macro \"" + name.text() + "\" is already defined at " + earlier + ", and the first counts");
        }
        Entity old = macros.get(base.text());
        inherited += old == null ? 0 : old.properties().size();
        if (inherited > MOST_INHERITED) {
            throw new WorldFileException(
                    name.where(),
                    "the macros up to this one have taken over more than " + MOST_INHERITED
                            + " properties of other macros");
        }
        Entity macro = builder(base, cursor, 1).buildMacro();
        macroEntities += macro.weight();
        macroValues += macro.values();
        if (macroEntities > MOST_MACRO_ENTITIES || macroValues > Entity.Builder.MOST_VALUES) {
            throw new WorldFileException(
                    name.where(),
                    "the macros up to this one hold more than " + MOST_MACRO_ENTITIES + " entities or "
                            + Entity.Builder.MOST_VALUES + " values, with those of the macros in them");
        }
        macros.putIfAbsent(name.text(), macro);
    }

    private void statement(Token word, TokenCursor cursor, Entity.Builder into, int depth) {
        if (cursor.at(Kind.OPEN)) {
            into.add(builder(word, cursor, depth + 1).build());
        } else {
            into.add(property(word, cursor));
        }
    }

    private Entity.Builder builder(Token word, TokenCursor cursor, int depth) {
        if (depth > DEEPEST_NESTING) {
            throw new WorldFileException(word.where(), "entities are nested deeper than " + DEEPEST_NESTING);
        }
        Token opening = cursor.next();
        var entity = new Entity.Builder(word.text(), macros.get(word.text()), word.where(), diagnostics);
        while (!cursor.at(Kind.CLOSE)) {
            if (cursor.at(Kind.END)) {
                throw new WorldFileException(
                        cursor.peek(0).where(),
                        "missing ')': \"" + word.text() + "\" opened at " + opening.where() + " is never closed");
            }
            Token inner = cursor.expect(Kind.WORD, "a property, an entity or ')'");
            if (inner.text().equals("include") || inner.text().equals("define")) {
                throw new WorldFileException(
                        inner.where(), inner.text() + " belongs at the top level, not inside \"" + word.text() + '"');
            }
            statement(inner, cursor, entity, depth);
        }
        cursor.next();
        return entity;
    }

    private Property property(Token name, TokenCursor cursor) {
        String word = name.text();
        int index = hasIndex(cursor) ? index(name, cursor) : Property.NO_INDEX;
        if (index != Property.NO_INDEX && isPart(cursor.peek(0))) {
            Token part = cursor.next();
            word = Property.key(word, index) + part.text();
            index = hasIndex(cursor) ? index(part, cursor) : Property.NO_INDEX;
        }
        String key = Property.key(word, index);
        return switch (cursor.peek(0).kind()) {
            case NUMBER, TEXT -> new Property(word, index, scalar(cursor.next()), name.where());
            case OPEN_TUPLE -> new Property(word, index, tuple(key, cursor), name.where());
            case WORD ->
                throw new WorldFileException(
                        cursor.peek(0).where(),
                        "expected the value of \"" + key + "\", found "
                                + cursor.peek(0).shown() + "; texts stand in double quotes");
            default ->
                throw new WorldFileException(
                        cursor.peek(0).where(),
                        "expected the value of \"" + key + "\" (a number, a text in double quotes or a tuple [ .. ])"
                                + ", found " + cursor.peek(0).shown());
        };
    }

    /** True for the second half of {@code polygon[0].points}. */
    private static boolean isPart(Token token) {
        return token.kind() == Kind.WORD && token.text().startsWith(".");
    }

    /**
     * True if the brackets are an index: {@code point[0] [1 2]} has one, {@code scale [1]} has none. An index is
     * followed by a value or by a part.
     */
    private static boolean hasIndex(TokenCursor cursor) {
        if (cursor.peek(0).kind() != Kind.OPEN_TUPLE
                || cursor.peek(1).kind() != Kind.NUMBER
                || cursor.peek(2).kind() != Kind.CLOSE_TUPLE) {
            return false;
        }
        return switch (cursor.peek(3).kind()) {
            case NUMBER, TEXT, OPEN_TUPLE -> true;
            default -> isPart(cursor.peek(3));
        };
    }

    private static int index(Token name, TokenCursor cursor) {
        cursor.next();
        Token number = cursor.next();
        cursor.next();
        double index = Double.parseDouble(number.text());
        if (index != StrictMath.rint(index) || index < 0 || index > HIGHEST_INDEX) {
            throw new WorldFileException(
                    number.where(),
                    "the index of \"" + name.text() + "\" must be a whole number from 0, not " + number.text());
        }
        return (int) index;
    }

    private static Value scalar(Token token) {
        return token.kind() == Kind.NUMBER
                ? new Value.Num(Double.parseDouble(token.text()), token.text(), token.where())
                : new Value.Text(token.text(), token.where());
    }

    private static Value tuple(String key, TokenCursor cursor) {
        Token opening = cursor.next();
        var items = new ArrayList<Value>();
        while (!cursor.at(Kind.CLOSE_TUPLE)) {
            if (!cursor.at(Kind.NUMBER) && !cursor.at(Kind.TEXT)) {
                throw new WorldFileException(
                        cursor.peek(0).where(),
                        "missing ']': the tuple of \"" + key + "\" opened at " + opening.where()
                                + " is not closed before " + cursor.peek(0).shown());
            }
            items.add(scalar(cursor.next()));
        }
        cursor.next();
        return new Value.Tuple(List.copyOf(items), opening.where());
    }

    /** A read position in the tokens of one file. */
    private static final class TokenCursor {
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
}
