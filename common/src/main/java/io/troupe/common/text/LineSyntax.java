package io.troupe.common.text;

import java.util.regex.Pattern;

/** What all files of lines have in common, whatever their statements are: names and comments. */
public final class LineSyntax {
    /** A name, as a regular expression: a letter, then letters, digits, {@code .}, {@code -} and {@code _}. */
    public static final String NAME = "\\p{L}[\\p{L}\\p{N}_.-]*";

    /** A colour: {@code #RRGGBB}. */
    public static final Pattern COLOUR = Pattern.compile("#\\p{XDigit}{6}(?![\\p{L}\\p{N}_-])");

    private LineSyntax() {}

    /**
     * Whether a comment begins at a place of a line: a {@code #} at its start or after a blank, unless it begins a
     * colour. At the start of a line it always begins a comment.
     */
    public static boolean isComment(String line, int at) {
        if (at >= line.length() || line.charAt(at) != '#') {
            return false;
        }
        if (line.substring(0, at).isBlank()) {
            return true;
        }
        return Character.isWhitespace(line.charAt(at - 1))
                && !COLOUR.matcher(line)
                        .region(at, line.length())
                        .useTransparentBounds(true)
                        .lookingAt();
    }
}
