package io.troupe.services.subsumption;

import java.util.OptionalInt;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** A tokenizer for one line of a table file. */
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

    /**
     * Returns the start of the comment: the first {@code #} that does not begin a colour. A {@code #} at the start of a
     * line always begins a comment.
     */
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

    /** The current position, for {@link #problem(int, String)}. */
    int position() {
        return at;
    }

    /** Skips the expected text if it comes next; a word only as a whole. */
    boolean skips(String expected) {
        boolean whole = !Character.isLetter(expected.charAt(0)) || nextWord().equals(expected);
        if (!whole || !text.startsWith(expected, at)) {
            return false;
        }
        at += expected.length();
        skipBlanks();
        return true;
    }

    /** Whether the text comes next. */
    boolean isAt(String expected) {
        return text.startsWith(expected, at);
    }

    void expect(String expected, String forWhat) {
        if (!skips(expected)) {
            throw unexpected("'" + expected + "' " + forWhat);
        }
    }

    /** Requires the end of the line. */
    void end() {
        if (!atEnd()) {
            throw unexpected("the end of the line");
        }
    }

    /** Returns the next word without consuming it; empty if the next token is not a word. */
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

    /** Consumes a colour of the form {@code #RRGGBB}, if one comes next. */
    OptionalInt literalColour() {
        Matcher colour = COLOUR.matcher(text).region(at, text.length());
        if (!colour.lookingAt()) {
            return OptionalInt.empty();
        }
        int value = Integer.parseInt(colour.group(1), 16);
        skip(colour.group());
        return OptionalInt.of(value);
    }

    /** Consumes the rest of the line. */
    String rest() {
        String rest = text.substring(at);
        at = text.length();
        return rest;
    }

    private void skip(String token) {
        at += token.length();
        skipBlanks();
    }

    /** Creates the error for an unexpected token. */
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

    /** Describes the comment at the end of the line if it may have been meant as a colour: {@code #12345}. */
    private String meantAsColour() {
        Matcher digits = NO_COLOUR.matcher(comment);
        return digits.lookingAt() ? " at the comment '" + digits.group() + "' (a colour is #RRGGBB)" : "";
    }

    /** Creates an error at a {@link #position}. */
    SubsumptionTableException problem(int position, String what) {
        int column = text.codePointCount(0, position) + 1;
        return new SubsumptionTableException(file, number, column, what);
    }
}
