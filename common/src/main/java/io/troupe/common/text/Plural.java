package io.troupe.common.text;

import java.util.Locale;

/** Formats a number with its noun. */
public final class Plural {
    private Plural() {}

    /** "1 robot", "2 robots"; only for nouns with a plural in s. */
    public static String of(long count, String noun) {
        return String.format(Locale.ROOT, "%d %s%s", count, noun, count == 1 ? "" : "s");
    }
}
