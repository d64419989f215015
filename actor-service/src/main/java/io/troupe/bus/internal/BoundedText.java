package io.troupe.bus.internal;

import io.troupe.actor.internal.loop.PlainText;
import java.nio.charset.StandardCharsets;

/** Texts of failures, so short and so well formed that a message about a failure can always be sent. */
public final class BoundedText {
    /** About the most characters. */
    public static final int MOST = 8_192;

    private static final String CUT = " .. (%d characters)";

    /** For the words about a cut, so that a text is not cut again where it is received. */
    private static final int ROOM = 40;

    private BoundedText() {}

    /**
     * The text, cut behind {@value #MOST} characters if it is longer than about that; half a surrogate pair becomes a
     * question mark.
     */
    public static String of(String text) {
        return of(text, MOST);
    }

    /** The text of an error or of an event, whatever the {@code toString} of a user's class does. */
    public static String of(Object what) {
        return of(PlainText.of(what, MOST));
    }

    /** The message of an error; another text if its class has none, or throws. */
    public static String ofMessage(Throwable error) {
        try {
            String message = error.getMessage();
            return message == null ? "(no message)" : of(message);
        } catch (Throwable broken) {
            return "(its message could not be read: " + broken.getClass().getName() + ")";
        }
    }

    /** The text, cut behind so many characters. */
    public static String of(String text, int most) {
        String cut = text.length() <= most + ROOM ? text : text.substring(0, most) + CUT.formatted(text.length());
        return cut.chars().noneMatch(c -> Character.isSurrogate((char) c))
                ? cut
                : new String(cut.getBytes(StandardCharsets.UTF_8), StandardCharsets.UTF_8);
    }
}
