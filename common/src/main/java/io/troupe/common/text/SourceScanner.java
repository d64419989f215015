package io.troupe.common.text;

import java.nio.file.Path;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * Reads a text token by token, and knows the position of the next one. The patterns of the tokens are those of the
 * language; blanks and comments are tokens too.
 *
 * <p><b>Threads.</b> For one thread.
 *
 * <p><b>Cost.</b> Of a token: its length.
 */
public final class SourceScanner {
    private static final String BYTE_ORDER_MARK = "\uFEFF"; // written by some editors
    private static final Pattern ANYTHING = Pattern.compile(".", Pattern.DOTALL);

    private final Path file;
    private final String text;
    private final Matcher matcher;
    private int line;
    private int lineStart;
    private int offset;

    /** Reads a text of any number of lines, which end with {@code \n}. */
    public SourceScanner(Path file, String text) {
        this(file, 1, text);
    }

    /** Reads one line of a file. */
    public SourceScanner(Path file, int line, String text) {
        this.file = file;
        this.text = text;
        this.line = line;
        matcher = ANYTHING.matcher(text).useTransparentBounds(true);
    }

    /** The text without the byte order mark that some editors write. */
    public static String withoutMark(String text) {
        return text.startsWith(BYTE_ORDER_MARK) ? text.substring(BYTE_ORDER_MARK.length()) : text;
    }

    /** The whole text. */
    public String text() {
        return text;
    }

    public boolean atEnd() {
        return offset == text.length();
    }

    /** The number of characters read. */
    public int offset() {
        return offset;
    }

    /** The position of the next token. Its column counts {@code char}s. */
    public SourcePosition where() {
        return new SourcePosition(file, line, offset - lineStart + 1);
    }

    /** Whether the text continues with {@code expected}. */
    public boolean isAt(String expected) {
        return text.startsWith(expected, offset);
    }

    /** The token that begins here, without reading it; empty if there is none of this pattern. */
    public String peek(Pattern token) {
        matcher.usePattern(token).region(offset, text.length());
        return matcher.lookingAt() ? matcher.group() : "";
    }

    /** Reads the token that begins here; empty if there is none of this pattern. */
    public String take(Pattern token) {
        String taken = peek(token);
        skip(taken.length());
        return taken;
    }

    /**
     * Reads characters of any kind, also line ends.
     *
     * @param length 0 to the number of characters that are left; the caller ensures it, and it is not checked
     */
    public void skip(int length) {
        int end = offset + length;
        for (int newline = text.indexOf('\n', offset, end);
                newline >= 0;
                newline = text.indexOf('\n', lineStart, end)) {
            line++;
            lineStart = newline + 1;
        }
        offset = end;
    }
}
