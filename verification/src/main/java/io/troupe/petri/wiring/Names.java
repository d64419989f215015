package io.troupe.petri.wiring;

import java.util.Collection;
import java.util.Comparator;
import java.util.Locale;
import java.util.regex.Pattern;

/** Names of components and calls: checks them, and suggests the nearest known name for an unknown one. */
final class Names {
    private static final Pattern WORD = Pattern.compile("[\\p{L}\\p{N}_-]+");

    private Names() {}

    /** Rejects a name that cannot be part of {@code component.call} and of a sentence. */
    static void requireWord(String what, String name) {
        if (!WORD.matcher(name).matches()) {
            throw new IllegalArgumentException(
                    what + " is \"" + name + "\", expected letters, digits, - and _ without spaces or dots");
        }
    }

    /** The suggestion that a message about an unknown name ends with. */
    static String hint(String wanted, Collection<String> known) {
        if (known.isEmpty()) {
            return "there are none";
        }
        var nearest = known.stream()
                .min(Comparator.<String>comparingInt(name -> distance(wanted, name))
                        .thenComparing(Comparator.naturalOrder()))
                .orElseThrow();
        var close = distance(wanted, nearest) <= Math.max(2, wanted.length() / 3);
        return (close ? "did you mean " + nearest + "? known: " : "known: ") + String.join(", ", known);
    }

    /** The edit distance of two names (Levenshtein): insertions, deletions and replacements, ignoring case. */
    static int distance(String one, String other) {
        var a = one.toLowerCase(Locale.ROOT);
        var b = other.toLowerCase(Locale.ROOT);
        var row = new int[b.length() + 1];
        for (var j = 0; j <= b.length(); j++) {
            row[j] = j;
        }
        for (var i = 1; i <= a.length(); i++) {
            var diagonal = row[0];
            row[0] = i;
            for (var j = 1; j <= b.length(); j++) {
                var replaced = diagonal + (a.charAt(i - 1) == b.charAt(j - 1) ? 0 : 1);
                diagonal = row[j];
                row[j] = Math.min(replaced, 1 + Math.min(row[j], row[j - 1]));
            }
        }
        return row[b.length()];
    }
}
