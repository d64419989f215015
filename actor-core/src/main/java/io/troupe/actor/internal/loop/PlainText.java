package io.troupe.actor.internal.loop;

import org.jspecify.annotations.Nullable;

/** Texts of users' objects. */
public final class PlainText {
    private static final int LONGEST = 80;

    private PlainText() {}

    /**
     * The text of an object, abbreviated; another text if its {@code toString} throws, overflows the stack, needs too
     * much memory or returns null.
     */
    public static String of(@Nullable Object what) {
        return of(what, LONGEST);
    }

    /** The text of an object, of so many characters at most; see {@link #of(Object)}. */
    public static String of(@Nullable Object what, int most) {
        String text;
        try {
            text = String.valueOf((Object) String.valueOf(what)); // twice: toString may return null
        } catch (Throwable broken) {
            return "what cannot be printed: " + broken.getClass().getName();
        }
        return text.length() <= most ? text : text.substring(0, most - 3) + "...";
    }
}
