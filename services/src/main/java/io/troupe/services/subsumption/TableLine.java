package io.troupe.services.subsumption;

import io.troupe.services.text.Suggestions;
import java.util.Collection;
import java.util.OptionalInt;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** Reads one line of a table's file from left to right. */
final class TableLine {
    /** A name: a letter, then letters, digits, {@code -} and {@code _}. */
    static final String WORD = "\\p{L}[\\p{L}\\p{N}_-]*";

    private static final Pattern BLANKS = Pattern.compile("\\s*");
    private static final Pattern NAME = Pattern.compile(WORD);
    private static final Pattern NUMBER = Pattern.compile("[-+]?(?:\\d+(?:\\.\\d+)?|\\.\\d+)(?:[eE][-+]?\\d+)?");
    private static final Pattern WHOLE = Pattern.compile("[-+]?\\d+");
    private static final Pattern COLOUR = Pattern.compile("#(\\p{XDigit}{6})(?![\\p{L}\\p{N}_-])");
    private static final Pattern NO_COLOUR = Pattern.compile("#\\p{Alnum}+");
    private static final Pattern ANYTHING = Pattern.compile("[\\p{L}\\p{N}_.+-]+|.");

    private final String file;
    private final int number;
    private final String text;
    private final String comment;
    private int at;

    TableLine(String file, int number, String line) {
        this.file = file;
        this.number = number;
        int end = commentStart(line);
        this.text = line.substring(0, end).stripTrailing();
        this.comment = line.substring(end);
        skipBlanks();
    }

    /** Where the comment begins: at a {@code #} that is not a colour; at the start of a line it always is a comment. */
    private static int commentStart(String line) {
        Matcher colour = COLOUR.matcher(line);
        for (int hash = line.indexOf('#'); hash >= 0; hash = line.indexOf('#', hash + 1)) {
            boolean first = line.substring(0, hash).isBlank();
            if (first
                    || !colour.region(hash, line.length())
                            .useTransparentBounds(true)
                            .lookingAt()) {
                return hash;
            }
        }
        return line.length();
    }

    private void skipBlanks() {
        Matcher blanks = BLANKS.matcher(text).region(at, text.length());
        at = blanks.lookingAt() ? blanks.end() : at;
    }

    boolean atEnd() {
        return at == text.length();
    }

    /** For {@link #problem(int, String)}: where it reads now. */
    int position() {
        return at;
    }

    /** Passes over this, if it comes next; a word only as a whole. */
    boolean skips(String expected) {
        boolean whole = !Character.isLetter(expected.charAt(0)) || nextWord().equals(expected);
        if (!whole || !text.startsWith(expected, at)) {
            return false;
        }
        at += expected.length();
        skipBlanks();
        return true;
    }

    /** Whether this comes next. */
    boolean isAt(String expected) {
        return text.startsWith(expected, at);
    }

    void expect(String expected, String forWhat) {
        if (!skips(expected)) {
            throw unexpected("'" + expected + "' " + forWhat);
        }
    }

    /** The end of the line must come. */
    void end() {
        if (!atEnd()) {
            throw unexpected("the end of the line");
        }
    }

    /** The next word; empty if something else comes. */
    String nextWord() {
        Matcher word = NAME.matcher(text).region(at, text.length());
        return word.lookingAt() ? word.group() : "";
    }

    String word(String expected) {
        String word = nextWord();
        if (word.isEmpty()) {
            throw unexpected(expected);
        }
        skip(word);
        return word;
    }

    boolean isAtNumber() {
        return NUMBER.matcher(text).region(at, text.length()).lookingAt();
    }

    double number(String expected) {
        Matcher decimal = NUMBER.matcher(text).region(at, text.length());
        if (!decimal.lookingAt()) {
            throw unexpected(expected);
        }
        double value = Double.parseDouble(decimal.group());
        if (Double.isInfinite(value)) {
            throw unexpected(expected);
        }
        skip(decimal.group());
        return value;
    }

    int whole(String expected, int least, int most) {
        Matcher digits = WHOLE.matcher(text).region(at, text.length());
        if (!digits.lookingAt()) {
            throw unexpected(expected);
        }
        try {
            int value = Integer.parseInt(digits.group());
            if (value >= least && value <= most) {
                skip(digits.group());
                return value;
            }
        } catch (NumberFormatException tooLarge) {
            throw unexpected(expected);
        }
        throw unexpected(expected);
    }

    /** A colour as {@code #RRGGBB}, if one comes next. */
    OptionalInt literalColour() {
        Matcher colour = COLOUR.matcher(text).region(at, text.length());
        if (!colour.lookingAt()) {
            return OptionalInt.empty();
        }
        int value = Integer.parseInt(colour.group(1), 16);
        skip(colour.group());
        return OptionalInt.of(value);
    }

    /** All that is left. */
    String rest() {
        String rest = text.substring(at);
        at = text.length();
        return rest;
    }

    private void skip(String token) {
        at += token.length();
        skipBlanks();
    }

    /** What comes next is not what was expected. */
    SubsumptionTableException unexpected(String expected) {
        return problem(at, found() + ", expected " + expected);
    }

    private String found() {
        if (atEnd()) {
            return "the line ends" + meantAsColour();
        }
        Matcher colour = COLOUR.matcher(text).region(at, text.length());
        if (colour.lookingAt()) {
            return "the colour " + colour.group() + " (a comment begins with '#' and a blank)";
        }
        Matcher anything = ANYTHING.matcher(text).region(at, text.length());
        return anything.lookingAt() ? "'" + anything.group() + "'" : "'" + text.charAt(at) + "'";
    }

    /** Which comment it ends at, if that may have been meant as a colour: {@code #12345}. */
    private String meantAsColour() {
        Matcher digits = NO_COLOUR.matcher(comment);
        return digits.lookingAt() ? " at the comment '" + digits.group() + "' (a colour is #RRGGBB)" : "";
    }

    /** Something is wrong at a {@link #position}. */
    SubsumptionTableException problem(int position, String what) {
        int column = text.codePointCount(0, position) + 1;
        return new SubsumptionTableException(file, number, column, what);
    }

    /** The end of a message about a name: what was expected, and which was meant. */
    static String expected(String what, String written, Collection<String> known) {
        String all = known.isEmpty() ? "none is known" : String.join(", ", known);
        return ", expected " + what + ": " + all
                + Suggestions.nearest(written, known)
                        .map(near -> " (did you mean '" + near + "'?)")
                        .orElse("");
    }
}
