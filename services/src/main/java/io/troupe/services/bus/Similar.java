package io.troupe.services.bus;

import java.util.Collection;
import java.util.List;

/** Names that somebody may have meant. */
final class Similar {
    private static final int FEW = 8;

    private Similar() {}

    /** What to say about a name that is not among those there are: the similar ones, or else the first few. */
    static String hint(String wanted, Collection<String> there) {
        if (there.isEmpty()) {
            return "there is none";
        }
        List<String> near = there.stream()
                .filter(each -> distance(wanted, each) <= Math.max(2, wanted.length() / 3))
                .sorted()
                .toList();
        if (!near.isEmpty()) {
            return "did you mean " + String.join(" or ", near) + "?";
        }
        var first = there.stream().sorted().limit(FEW).toList();
        return "there are " + String.join(", ", first) + (there.size() > FEW ? ", .." : "");
    }

    /** How many letters to insert, delete or replace. */
    private static int distance(String from, String to) {
        int[] before = new int[to.length() + 1];
        for (int j = 0; j <= to.length(); j++) {
            before[j] = j;
        }
        for (int i = 1; i <= from.length(); i++) {
            int[] now = new int[to.length() + 1];
            now[0] = i;
            for (int j = 1; j <= to.length(); j++) {
                int replaced = before[j - 1] + (from.charAt(i - 1) == to.charAt(j - 1) ? 0 : 1);
                now[j] = Math.min(replaced, 1 + Math.min(before[j], now[j - 1]));
            }
            before = now;
        }
        return before[to.length()];
    }
}
