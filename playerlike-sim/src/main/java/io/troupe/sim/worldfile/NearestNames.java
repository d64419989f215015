package io.troupe.sim.worldfile;

import java.util.Collection;
import java.util.Locale;
import java.util.stream.Collectors;

/** Finds the known name nearest to a misspelt one. */
final class NearestNames {
    /** Limit of the length: longer names are not misspellings, and the cost is the product of both lengths. */
    private static final int LONGEST = 100;

    private NearestNames() {}

    /** End of an error message: the nearest known name and all of them. */
    static String of(String written, Collection<String> known) {
        String nearest = nearest(written, known);
        return (nearest.isEmpty() ? "; " : "; did you mean \"" + nearest + "\"? ") + "known: " + list(known);
    }

    /** End of an error message: the nearest known name, or all of them (there may be many) if none is near. */
    static String briefly(String written, Collection<String> known) {
        String nearest = nearest(written, known);
        return nearest.isEmpty() ? "; known: " + list(known) : "; did you mean \"" + nearest + "\"?";
    }

    /** The known name with the smallest edit distance, empty if that exceeds a third of the letters. */
    static String nearest(String written, Collection<String> known) {
        String best = "";
        if (written.length() > LONGEST) {
            return best;
        }
        int fewest = Math.max(1, written.length() / 3) + 1;
        for (String name : known) {
            if (Math.abs(written.length() - name.length()) >= fewest) {
                continue;
            }
            int slips = slips(written.toLowerCase(Locale.ROOT), name.toLowerCase(Locale.ROOT));
            if (slips < fewest) {
                fewest = slips;
                best = name;
            }
        }
        return best;
    }

    static String list(Collection<String> names) {
        return names.isEmpty() ? "none" : names.stream().sorted().collect(Collectors.joining(", "));
    }

    /** Optimal string alignment distance: letters left out, added, changed, or swapped with the neighbour. */
    static int slips(String from, String to) {
        int[][] d = new int[from.length() + 1][to.length() + 1];
        for (int i = 0; i <= from.length(); i++) {
            for (int j = 0; j <= to.length(); j++) {
                if (i == 0 || j == 0) {
                    d[i][j] = i + j;
                    continue;
                }
                int change = from.charAt(i - 1) == to.charAt(j - 1) ? 0 : 1;
                d[i][j] = Math.min(d[i - 1][j - 1] + change, 1 + Math.min(d[i - 1][j], d[i][j - 1]));
                if (i > 1
                        && j > 1
                        && from.charAt(i - 1) == to.charAt(j - 2)
                        && from.charAt(i - 2) == to.charAt(j - 1)) {
                    d[i][j] = Math.min(d[i][j], d[i - 2][j - 2] + 1);
                }
            }
        }
        return d[from.length()][to.length()];
    }
}
