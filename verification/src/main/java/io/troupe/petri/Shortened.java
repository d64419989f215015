package io.troupe.petri;

import java.util.List;
import java.util.stream.Collectors;

/** Lists in summaries, which a large net would make a million names long. */
final class Shortened {
    private static final int MOST = 200;

    private Shortened() {}

    /** As a list prints itself, but of a long list only the beginning and how many follow. */
    static String list(List<?> items) {
        if (items.size() <= MOST) {
            return items.toString();
        }
        return items.stream().limit(MOST).map(String::valueOf).collect(Collectors.joining(", ", "[", ", .. and "))
                + (items.size() - MOST) + " more]";
    }
}
