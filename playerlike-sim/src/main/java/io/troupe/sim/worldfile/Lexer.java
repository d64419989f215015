package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.worldfile.Token.Kind;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.regex.Pattern;

/** Splits the text of a world or configuration file into tokens; {@code #} starts a comment to the end of the line. */
final class Lexer {
    private static final Pattern NUMBER = Pattern.compile("[+-]?(\\d+\\.?\\d*|\\.\\d+)([eE][+-]?\\d+)?");

    static final int MOST_TOKENS = 2_000_000;

    private final String text;
    private final Path file;
    private final List<Token> tokens = new ArrayList<>();
    private int at;
    private int line = 1;
    private int lineStart;

    private Lexer(String text, Path file) {
        this.text = text;
        this.file = file;
    }

    /** The tokens in order; the last is always {@link Kind#END}. */
    static List<Token> tokens(String text, Path file) {
        var lexer = new Lexer(text, file);
        lexer.run();
        return lexer.tokens;
    }

    private void run() {
        while (at < text.length()) {
            char c = text.charAt(at);
            if (c == '\n') {
                at++;
                line++;
                lineStart = at;
            } else if (c == ' ' || c == '\t' || c == '\r' || c == '\f') {
                at++;
            } else if (c == '#') {
                at = endOfLine();
            } else {
                token(c);
            }
        }
        tokens.add(new Token(Kind.END, "", here()));
    }

    private void token(char c) {
        if (tokens.size() >= MOST_TOKENS - 1) {
            throw new WorldFileException(
                    here(), "more than " + MOST_TOKENS + " words, numbers and brackets in one file");
        }
        switch (c) {
            case '(' -> add(Kind.OPEN, at + 1);
            case ')' -> add(Kind.CLOSE, at + 1);
            case '[' -> add(Kind.OPEN_TUPLE, at + 1);
            case ']' -> add(Kind.CLOSE_TUPLE, at + 1);
            case '"' -> quoted();
            case ',', ';' ->
                throw new WorldFileException(
                        here(), "unexpected '" + c + "': values are separated by spaces, nothing else");
            default -> {
                if (startsPart(c)) {
                    add(Kind.WORD, endOfRun());
                } else if (startsNumber(c)) {
                    number();
                } else if (startsWord(c)) {
                    add(Kind.WORD, endOfRun());
                } else {
                    throw new WorldFileException(here(), "unexpected character " + shown(c));
                }
            }
        }
    }

    private void quoted() {
        int close = text.indexOf('"', at + 1);
        if (close < 0 || close > endOfLine()) {
            throw new WorldFileException(here(), "this text has no closing '\"' on its line");
        }
        tokens.add(new Token(Kind.TEXT, text.substring(at + 1, close), here()));
        at = close + 1;
    }

    private void number() {
        int end = endOfRun();
        String written = text.substring(at, end);
        if (!NUMBER.matcher(written).matches()) {
            throw new WorldFileException(here(), "'" + written + "' is not a number");
        }
        if (!Double.isFinite(Double.parseDouble(written))) {
            throw new WorldFileException(here(), "'" + written + "' is too large: numbers must be finite");
        }
        add(Kind.NUMBER, end);
    }

    private void add(Kind kind, int end) {
        tokens.add(new Token(kind, text.substring(at, end), here()));
        at = end;
    }

    private int endOfRun() {
        int end = at;
        while (end < text.length() && (startsWord(text.charAt(end)) || startsNumber(text.charAt(end)))) {
            end++;
        }
        return end;
    }

    private int endOfLine() {
        int end = text.indexOf('\n', at);
        return end < 0 ? text.length() : end;
    }

    private SourcePosition here() {
        return new SourcePosition(file, line, at - lineStart + 1);
    }

    /** True at the point in {@code polygon[0].points}: after a bracket, without a space, and before a letter. */
    private boolean startsPart(char c) {
        return c == '.'
                && at > 0
                && text.charAt(at - 1) == ']'
                && at + 1 < text.length()
                && startsWord(text.charAt(at + 1));
    }

    private static boolean startsWord(char c) {
        return c >= 'a' && c <= 'z' || c >= 'A' && c <= 'Z' || c == '_';
    }

    private static boolean startsNumber(char c) {
        return c >= '0' && c <= '9' || c == '+' || c == '-' || c == '.';
    }

    private static String shown(char c) {
        return c > ' ' && c < 127 ? "'" + c + "'" : String.format(Locale.ROOT, "U+%04X", (int) c);
    }
}
