package io.troupe.common.text;

import java.util.Collection;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.stream.Collectors;

/**
 * Finds the known name that is most similar to a misspelled one, and phrases it for error messages.
 *
 * <p>A <em>hint</em> is a sentence, a <em>clause</em> begins with {@code "; "}. The languages quote and list names
 * differently, and their messages are compared by tests, so each phrasing has a method.
 */
public final class Suggestions {
    /** Longer names get no suggestion: the comparison takes time in proportion to the product of both lengths. */
    private static final int MAX_LENGTH = 100;

    private static final int MAX_LISTED = 8;
    private static final int MAX_EXPECTED = 12;
    private static final int MIN_PREFIX = 3;

    private Suggestions() {}

    /**
     * Returns the known name with the smallest edit distance. An edit omits, adds or changes a letter, or swaps two
     * neighbours; case is ignored.
     *
     * @return the first of the names with the smallest distance; empty if that is more than a third of the length of
     *     the written name (an edit distance of 1 is always accepted), or if that name has no letters
     */
    public static Optional<String> nearest(String written, Collection<String> known) {
        return written.length() > MAX_LENGTH
                ? Optional.empty()
                : nearest(written, known, Math.max(1, written.length() / 3), 1);
    }

    /** {@code did you mean NAME?}, else the first few names, sorted: {@code there are A, B, ..}. */
    public static String hint(String written, Collection<String> known) {
        return known.isEmpty()
                ? "there is none"
                : nearest(written, known)
                        .map(name -> "did you mean " + name + "?")
                        .orElseGet(() -> "there are " + some(known, MAX_LISTED));
    }

    /** {@code did you mean "NAME"? expected one of A, B, ..}, with the first few names, sorted. */
    public static String hintWithSome(String written, Collection<String> known) {
        String expected = "expected one of " + some(known, MAX_EXPECTED);
        return nearest(written, known)
                .map(name -> "did you mean \"" + name + "\"? " + expected)
                .orElse(known.isEmpty() ? "there is none" : expected);
    }

    /**
     * {@code did you mean NAME? known: A, B}, with all names in their order. Two edits are always accepted, and swapped
     * neighbours are two edits.
     */
    public static String hintWithAll(String written, Collection<String> known) {
        if (known.isEmpty()) {
            return "there are none";
        }
        List<String> sorted = known.stream().sorted().toList();
        return nearest(written, sorted, Math.max(2, written.length() / 3), 2)
                        .map(name -> "did you mean " + name + "? ")
                        .orElse("")
                + "known: " + String.join(", ", known);
    }

    /** {@code ; did you mean "NAME"? known: A, B}, with all names, sorted. */
    public static String clauseWithAll(String written, Collection<String> known) {
        String question = clause(written, known);
        return (question.isEmpty() ? "; " : question + " ") + "known: " + sorted(known);
    }

    /** {@code ; did you mean "NAME"?}, else all names, sorted: {@code ; known: A, B}. */
    public static String clauseOrAll(String written, Collection<String> known) {
        String question = clause(written, known);
        return question.isEmpty() ? "; known: " + sorted(known) : question;
    }

    /** {@code ; did you mean "NAME"?}, else nothing. */
    public static String clause(String written, Collection<String> known) {
        return nearest(written, known)
                .map(name -> "; did you mean \"" + name + "\"?")
                .orElse("");
    }

    /**
     * For a word of a command line: {@code ; did you mean NAME?}, also if it is the beginning of a name, else all names
     * in their order; for an option that begins with {@code -} nothing.
     */
    public static String clauseForArgument(String written, Collection<String> known) {
        return nearest(written, known)
                .or(() -> known.stream()
                        .filter(each -> written.length() >= MIN_PREFIX && each.startsWith(written))
                        .findFirst())
                .map(name -> "; did you mean " + name + "?")
                .orElseGet(() -> written.startsWith("-") ? "" : "; there are " + String.join(", ", known));
    }

    /** {@code , expected WHAT: A, B (did you mean 'NAME'?)}, with all names in their order. */
    public static String expected(String what, String written, Collection<String> known) {
        String all = known.isEmpty() ? "none is known" : String.join(", ", known);
        return ", expected " + what + ": " + all
                + nearest(written, known)
                        .map(name -> " (did you mean '" + name + "'?)")
                        .orElse("");
    }

    /** All names, sorted, or {@code none}. */
    public static String sorted(Collection<String> names) {
        return names.isEmpty() ? "none" : some(names, names.size());
    }

    private static String some(Collection<String> names, int most) {
        return names.stream().sorted().limit(most).collect(Collectors.joining(", "))
                + (names.size() > most ? ", .." : "");
    }

    private static Optional<String> nearest(String written, Collection<String> known, int mostEdits, int swapEdits) {
        String lower = written.toLowerCase(Locale.ROOT);
        int smallest = mostEdits + 1;
        String best = "";
        for (String name : known) {
            int distance = Math.abs(written.length() - name.length()) >= smallest
                    ? smallest // too different in length to be nearer
                    : distance(lower, name.toLowerCase(Locale.ROOT), swapEdits);
            if (distance < smallest) {
                smallest = distance;
                best = name;
            }
        }
        return Optional.of(best).filter(name -> !name.isEmpty());
    }

    /**
     * The optimal string alignment distance, with three rows of the table in memory.
     *
     * @param swapEdits the edits for which two swapped neighbours count; 2 gives the Levenshtein distance
     */
    static int distance(String from, String to, int swapEdits) {
        int[] beforeLast = new int[to.length() + 1];
        int[] last = new int[to.length() + 1];
        int[] row = new int[to.length() + 1];
        for (int j = 0; j <= to.length(); j++) {
            last[j] = j;
        }
        for (int i = 1; i <= from.length(); i++) {
            row[0] = i;
            for (int j = 1; j <= to.length(); j++) {
                int change = from.charAt(i - 1) == to.charAt(j - 1) ? 0 : 1;
                row[j] = Math.min(last[j - 1] + change, 1 + Math.min(last[j], row[j - 1]));
                if (i > 1
                        && j > 1
                        && from.charAt(i - 1) == to.charAt(j - 2)
                        && from.charAt(i - 2) == to.charAt(j - 1)) {
                    row[j] = Math.min(row[j], beforeLast[j - 2] + swapEdits);
                }
            }
            int[] oldest = beforeLast;
            beforeLast = last;
            last = row;
            row = oldest;
        }
        return last[to.length()];
    }
}
