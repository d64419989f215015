package io.troupe.demo.terminal;

import java.util.Locale;

/** Numbers with their noun. */
public final class Plural {
    private Plural() {}

    /** "1 robot", "2 robots"; for nouns whose plural has only an s more. */
    public static String of(long count, String noun) {
        return String.format(Locale.ROOT, "%d %s%s", count, noun, count == 1 ? "" : "s");
    }
}
