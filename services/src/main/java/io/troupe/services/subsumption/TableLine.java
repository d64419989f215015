package io.troupe.services.subsumption;

import io.troupe.common.text.LineSyntax;
import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.SourceScanner;
import java.nio.file.Path;
import java.util.OptionalInt;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** A tokenizer for one line of a table file. */
final class TableLine {
    private static final Pattern BLANKS = Pattern.compile("\\s*");
    private static final Pattern NAME = Pattern.compile(LineSyntax.NAME);
    private static final Pattern NUMBER = Pattern.compile("[-+]?(?:\\d+(?:\\.\\d+)?|\\.\\d+)(?:[eE][-+]?\\d+)?");
    private static final Pattern WHOLE = Pattern.compile("[-+]?\\d+");
    private static final Pattern NO_COLOUR = Pattern.compile("#\\p{Alnum}+");
    private static final Pattern ANYTHING = Pattern.compile("[\\p{L}\\p{N}_.+-]+|.");
    private static final Pattern REST = Pattern.compile(".*", Pattern.DOTALL);

    private final SourceScanner scanner;
    private final SourcePosition start;
    private final String comment;

    TableLine(Path file, int number, String line) {
        int end = commentStart(line);
        this.scanner = new SourceScanner(file, number, line.substring(0, end).stripTrailing());
        this.start = scanner.where();
        this.comment = line.substring(end);
        scanner.take(BLANKS);
    }

    private static int commentStart(String line) {
        int at = line.indexOf('#');
        while (at >= 0 && !LineSyntax.isComment(line, at)) {
            at = line.indexOf('#', at + 1);
        }
        return at < 0 ? line.length() : at;
    }

    boolean atEnd() {
        return scanner.atEnd();
    }

    /** The current position, for {@link #problem(int, String)}. */
    int position() {
        return scanner.offset();
    }

    /** Skips the expected text if it comes next; a word only as a whole. */
    boolean skips(String expected) {
        boolean whole = !Character.isLetter(expected.charAt(0)) || nextWord().equals(expected);
        if (!whole || !isAt(expected)) {
            return false;
        }
        skip(expected);
        return true;
    }

    /** Whether the text comes next. */
    boolean isAt(String expected) {
        return scanner.isAt(expected);
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
        return scanner.peek(NAME);
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
        return !scanner.peek(NUMBER).isEmpty();
    }

    double number(String expected) {
        String decimal = scanner.peek(NUMBER);
        double value = decimal.isEmpty() ? Double.POSITIVE_INFINITY : Double.parseDouble(decimal);
        if (Double.isInfinite(value)) {
            throw unexpected(expected);
        }
        skip(decimal);
        return value;
    }

    int whole(String expected, int least, int most) {
        String digits = scanner.peek(WHOLE);
        try {
            int value = Integer.parseInt(digits);
            if (value >= least && value <= most) {
                skip(digits);
                return value;
            }
        } catch (NumberFormatException noneOrTooLarge) {
            throw unexpected(expected);
        }
        throw unexpected(expected);
    }

    /** Consumes a colour of the form {@code #RRGGBB}, if one comes next. */
    OptionalInt literalColour() {
        String colour = scanner.peek(LineSyntax.COLOUR);
        if (colour.isEmpty()) {
            return OptionalInt.empty();
        }
        skip(colour);
        return OptionalInt.of(Integer.parseInt(colour.substring(1), 16));
    }

    /** Consumes the rest of the line. */
    String rest() {
        return scanner.take(REST);
    }

    private void skip(String token) {
        scanner.skip(token.length());
        scanner.take(BLANKS);
    }

    /** Creates the error for an unexpected token. */
    SubsumptionTableException unexpected(String expected) {
        return problem(position(), found() + ", expected " + expected);
    }

    private String found() {
        if (atEnd()) {
            return "the line ends" + meantAsColour();
        }
        String colour = scanner.peek(LineSyntax.COLOUR);
        if (!colour.isEmpty()) {
            return "the colour " + colour + " (in a comment a blank follows the '#')";
        }
        String anything = scanner.peek(ANYTHING);
        return "'" + (anything.isEmpty() ? scanner.text().charAt(position()) : anything) + "'";
    }

    /** Describes the comment at the end of the line if it may have been meant as a colour: {@code #12345}. */
    private String meantAsColour() {
        Matcher digits = NO_COLOUR.matcher(comment);
        return digits.lookingAt() ? " at the comment '" + digits.group() + "' (a colour is #RRGGBB)" : "";
    }

    /** Creates an error at a {@link #position}; its column counts code points. */
    SubsumptionTableException problem(int position, String what) {
        int column = scanner.text().codePointCount(0, position) + 1;
        return new SubsumptionTableException(new SourcePosition(start.file(), start.line(), column), what);
    }
}
