package io.troupe.services.component.application;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

/**
 * Tokens of one line of an application file, which are read one after the other.
 *
 * <p><b>Units and shapes.</b> Blanks separate tokens, quotes keep blanks in a token, {@code #} at the start of a token
 * begins a comment, and <code>${name}</code> is replaced by a value of the caller. Columns count from 1.
 */
final class LineTokens {
    /** A token without its quotes. */
    record Token(String text, int column) {}

    private static final Pattern NAME = Pattern.compile("[A-Za-z][A-Za-z0-9_.-]*");

    private final String file;
    private final int line;
    private final List<Token> tokens;
    private final int endColumn;
    private int next;

    private LineTokens(String file, int line, List<Token> tokens, int endColumn) {
        this.file = file;
        this.line = line;
        this.tokens = tokens;
        this.endColumn = endColumn;
    }

    static LineTokens of(String file, int line, String text, Map<String, String> values) {
        List<Token> tokens = new ArrayList<>();
        int at = 0;
        while (true) {
            while (at < text.length() && Character.isWhitespace(text.charAt(at))) {
                at++;
            }
            if (at == text.length() || text.charAt(at) == '#') {
                break;
            }
            int start = at;
            var token = new StringBuilder();
            boolean quoted = false;
            for (; at < text.length() && (quoted || !Character.isWhitespace(text.charAt(at))); at++) {
                if (text.charAt(at) == '"') {
                    quoted = !quoted;
                } else {
                    token.append(text.charAt(at));
                }
            }
            if (quoted) {
                throw error(file, line, start + 1, "a quote is not closed, expected \" before the end of the line");
            }
            tokens.add(new Token(substitute(file, line, start + 1, token.toString(), values), start + 1));
        }
        return new LineTokens(file, line, tokens, text.stripTrailing().length() + 1);
    }

    private static String substitute(String file, int line, int column, String text, Map<String, String> values) {
        var done = new StringBuilder();
        int at = 0;
        for (int begin = text.indexOf("${"); begin >= 0; begin = text.indexOf("${", at)) {
            int end = text.indexOf('}', begin);
            String name = end < 0 ? "" : text.substring(begin + 2, end);
            if (!values.containsKey(name)) {
                throw error(
                        file,
                        line,
                        column,
                        "${" + name + "} has no value here, expected one of "
                                + values.keySet().stream()
                                        .sorted()
                                        .map(each -> "${" + each + "}")
                                        .toList());
            }
            done.append(text, at, begin).append(values.get(name));
            at = end + 1;
        }
        return done.append(text.substring(at)).toString();
    }

    boolean isEmpty() {
        return tokens.isEmpty();
    }

    boolean hasNext() {
        return next < tokens.size();
    }

    boolean isNext(String token) {
        return hasNext() && tokens.get(next).text().equals(token);
    }

    /**
     * The next token.
     *
     * @param expected description of the token for the error at the end of the line
     */
    Token next(String expected) {
        if (!hasNext()) {
            throw error(endColumn, "the line ends here, expected " + expected);
        }
        return tokens.get(next++);
    }

    /** The next token, which must be a name. */
    String name(String expected) {
        Token token = next(expected);
        if (!NAME.matcher(token.text()).matches()) {
            throw error(
                    token,
                    "\"" + token.text() + "\" is no name, expected " + expected + ": letters, digits, . _ and -");
        }
        return token.text();
    }

    /** Skips the next token, which must be the given word. */
    void expect(String token) {
        Token found = next("\"" + token + "\"");
        if (!found.text().equals(token)) {
            throw error(found, "found \"" + found.text() + "\", expected \"" + token + "\"");
        }
    }

    void expectEnd() {
        if (hasNext()) {
            Token found = tokens.get(next);
            throw error(found, "found \"" + found.text() + "\", expected the end of the line");
        }
    }

    ApplicationFileException error(Token at, String what) {
        return error(at.column(), what);
    }

    private ApplicationFileException error(int column, String what) {
        return error(file, line, column, what);
    }

    private static ApplicationFileException error(String file, int line, int column, String what) {
        return new ApplicationFileException(file + ":" + line + ":" + column + ": " + what);
    }
}
