package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.SourceScanner;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.regex.Pattern;

/** Splits the text of a world or configuration file into tokens; {@code #} starts a comment to the end of the line. */
final class Lexer {
    static final int MOST_TOKENS = 2_000_000;

    private static final Pattern BLANKS = Pattern.compile("[ \\t\\r\\f\\n]++|#[^\\n]*+");
    private static final Pattern QUOTED = Pattern.compile("\"[^\"\\n]*+\"");
    /** Also {@code .points} in {@code polygon[0].points}: after a bracket, without a space. */
    private static final Pattern WORD = Pattern.compile("(?:[a-zA-Z_]|(?<=])\\.(?=[a-zA-Z_]))[a-zA-Z_0-9+.-]*+");

    private static final Pattern NUMBER_LIKE = Pattern.compile("[0-9+.-][a-zA-Z_0-9+.-]*+");
    private static final Pattern NUMBER = Pattern.compile("[+-]?(\\d+\\.?\\d*|\\.\\d+)([eE][+-]?\\d+)?");
    private static final Pattern SYMBOL = Pattern.compile(".", Pattern.DOTALL);

    private final SourceScanner scanner;
    private final List<Token> tokens = new ArrayList<>();

    /**
     * A word, number, text or bracket of a file, with its position.
     *
     * @param text as written; of a text in quotes without the quotes
     */
    record Token(Kind kind, String text, SourcePosition where) {
        /** The token as shown in messages. */
        String shown() {
            return switch (kind) {
                case END -> "the end of the file";
                case TEXT -> '"' + text + '"';
                default -> "'" + text + "'";
            };
        }
    }

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

    private Lexer(SourceScanner scanner) {
        this.scanner = scanner;
    }

    /** The tokens in order; the last is always {@link Kind#END}. */
    static List<Token> tokens(String text, Path file) {
        var lexer = new Lexer(new SourceScanner(file, text));
        lexer.run();
        return lexer.tokens;
    }

    private void run() {
        skipBlanks();
        while (!scanner.atEnd()) {
            SourcePosition where = scanner.where();
            if (tokens.size() >= MOST_TOKENS - 1) {
                throw new WorldFileException(
                        where, "more than " + MOST_TOKENS + " words, numbers and brackets in one file");
            }
            tokens.add(token(where));
            skipBlanks();
        }
        tokens.add(new Token(Kind.END, "", scanner.where()));
    }

    private void skipBlanks() {
        while (!scanner.take(BLANKS).isEmpty()) {
            // the next blanks or comment
        }
    }

    private Token token(SourcePosition where) {
        String word = scanner.take(WORD);
        if (!word.isEmpty()) {
            return new Token(Kind.WORD, word, where);
        }
        String number = scanner.take(NUMBER_LIKE);
        if (!number.isEmpty()) {
            return number(number, where);
        }
        String quoted = scanner.take(QUOTED);
        if (!quoted.isEmpty()) {
            return new Token(Kind.TEXT, quoted.substring(1, quoted.length() - 1), where);
        }
        String symbol = scanner.take(SYMBOL);
        return switch (symbol) {
            case "(" -> new Token(Kind.OPEN, symbol, where);
            case ")" -> new Token(Kind.CLOSE, symbol, where);
            case "[" -> new Token(Kind.OPEN_TUPLE, symbol, where);
            case "]" -> new Token(Kind.CLOSE_TUPLE, symbol, where);
            case "\"" -> throw new WorldFileException(where, "this text has no closing '\"' on its line");
            case ",", ";" ->
                throw new WorldFileException(
                        where, "unexpected '" + symbol + "': values are separated by spaces, nothing else");
            default -> throw new WorldFileException(where, "unexpected character " + shown(symbol.charAt(0)));
        };
    }

    private static Token number(String written, SourcePosition where) {
        if (!NUMBER.matcher(written).matches()) {
            throw new WorldFileException(where, "'" + written + "' is not a number");
        }
        if (!Double.isFinite(Double.parseDouble(written))) {
            throw new WorldFileException(where, "'" + written + "' is too large: numbers must be finite");
        }
        return new Token(Kind.NUMBER, written, where);
    }

    private static String shown(char c) {
        return c > ' ' && c < 127 ? "'" + c + "'" : String.format(Locale.ROOT, "U+%04X", (int) c);
    }
}
