package io.troupe.common.text;

import java.util.Collection;
import java.util.Locale;
import java.util.Optional;
import java.util.stream.Collectors;

/** Finds the known name that is most similar to a misspelled one, for error messages. */
public final class Suggestions {
    /** Longer names get no suggestion: the comparison takes time in proportion to the product of both lengths. */
    private static final int MAX_LENGTH = 100;

    private static final int MAX_LISTED = 8;

    private Suggestions() {}

    /**
     * Returns the known name with the smallest edit distance. An edit omits, adds or changes a letter, or swaps two
     * neighbours; case is ignored.
     *
     * @return the first of the names with the smallest distance; empty if that is more than a third of the length of
     *     the written name (an edit distance of 1 is always accepted)
     */
    public static Optional<String> nearest(String written, Collection<String> known) {
        if (written.length() > MAX_LENGTH) {
            return Optional.empty();
        }
        String lower = written.toLowerCase(Locale.ROOT);
        int smallest = Math.max(1, written.length() / 3) + 1;
        String best = null;
        for (String name : known) {
            int distance = Math.abs(written.length() - name.length()) >= smallest
                    ? smallest // too different in length to be nearer
                    : distance(lower, name.toLowerCase(Locale.ROOT));
            if (distance < smallest) {
                smallest = distance;
                best = name;
            }
        }
        return Optional.ofNullable(best);
    }

    /** Returns the end of an error message: the most similar name, or else the first few known names. */
    public static String hint(String written, Collection<String> known) {
        if (known.isEmpty()) {
            return "there is none";
        }
        return nearest(written, known)
                .map(name -> "did you mean " + name + "?")
                .orElseGet(() -> "there are "
                        + known.stream().sorted().limit(MAX_LISTED).collect(Collectors.joining(", "))
                        + (known.size() > MAX_LISTED ? ", .." : ""));
    }

    /** The optimal string alignment distance, with three rows of the table in memory. */
    private static int distance(String from, String to) {
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
                    row[j] = Math.min(row[j], beforeLast[j - 2] + 1);
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
