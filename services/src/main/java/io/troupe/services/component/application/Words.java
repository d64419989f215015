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
final class Words {
    /** A token without its quotes. */
    record Word(String text, int column) {}

    private static final Pattern NAME = Pattern.compile("[A-Za-z][A-Za-z0-9_.-]*");

    private final String file;
    private final int line;
    private final List<Word> words;
    private final int endColumn;
    private int next;

    private Words(String file, int line, List<Word> words, int endColumn) {
        this.file = file;
        this.line = line;
        this.words = words;
        this.endColumn = endColumn;
    }

    static Words of(String file, int line, String text, Map<String, String> values) {
        List<Word> words = new ArrayList<>();
        int at = 0;
        while (true) {
            while (at < text.length() && Character.isWhitespace(text.charAt(at))) {
                at++;
            }
            if (at == text.length() || text.charAt(at) == '#') {
                break;
            }
            int start = at;
            var word = new StringBuilder();
            boolean quoted = false;
            for (; at < text.length() && (quoted || !Character.isWhitespace(text.charAt(at))); at++) {
                if (text.charAt(at) == '"') {
                    quoted = !quoted;
                } else {
                    word.append(text.charAt(at));
                }
            }
            if (quoted) {
                throw problem(file, line, start + 1, "a quote is not closed, expected \" before the end of the line");
            }
            words.add(new Word(substitute(file, line, start + 1, word.toString(), values), start + 1));
        }
        return new Words(file, line, words, text.stripTrailing().length() + 1);
    }

    private static String substitute(String file, int line, int column, String text, Map<String, String> values) {
        var done = new StringBuilder();
        int at = 0;
        for (int begin = text.indexOf("${"); begin >= 0; begin = text.indexOf("${", at)) {
            int end = text.indexOf('}', begin);
            String name = end < 0 ? "" : text.substring(begin + 2, end);
            if (!values.containsKey(name)) {
                throw problem(
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
        return words.isEmpty();
    }

    boolean hasNext() {
        return next < words.size();
    }

    boolean isNext(String word) {
        return hasNext() && words.get(next).text().equals(word);
    }

    /**
     * The next token.
     *
     * @param expected description of the token for the error at the end of the line
     */
    Word next(String expected) {
        if (!hasNext()) {
            throw problem(endColumn, "the line ends here, expected " + expected);
        }
        return words.get(next++);
    }

    /** The next token, which must be a name. */
    String name(String expected) {
        Word word = next(expected);
        if (!NAME.matcher(word.text()).matches()) {
            throw problem(
                    word, "\"" + word.text() + "\" is no name, expected " + expected + ": letters, digits, . _ and -");
        }
        return word.text();
    }

    /** Skips the next token, which must be the given word. */
    void expect(String word) {
        Word found = next("\"" + word + "\"");
        if (!found.text().equals(word)) {
            throw problem(found, "found \"" + found.text() + "\", expected \"" + word + "\"");
        }
    }

    void expectEnd() {
        if (hasNext()) {
            Word found = words.get(next);
            throw problem(found, "found \"" + found.text() + "\", expected the end of the line");
        }
    }

    ApplicationFileException problem(Word at, String what) {
        return problem(at.column(), what);
    }

    private ApplicationFileException problem(int column, String what) {
        return problem(file, line, column, what);
    }

    private static ApplicationFileException problem(String file, int line, int column, String what) {
        return new ApplicationFileException(file + ":" + line + ":" + column + ": " + what);
    }
}
