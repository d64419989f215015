package io.troupe.petri;

import java.util.List;
import java.util.stream.Collectors;

/** Prints lists for summaries, in which a large net could have a million names. */
final class Shortened {
    private static final int MOST = 200;

    private Shortened() {}

    /** The list as it prints itself; of a long list only the beginning and the number of the rest. */
    static String list(List<?> items) {
        if (items.size() <= MOST) {
            return items.toString();
        }
        return items.stream().limit(MOST).map(String::valueOf).collect(Collectors.joining(", ", "[", ", .. and "))
                + (items.size() - MOST) + " more]";
    }
}
