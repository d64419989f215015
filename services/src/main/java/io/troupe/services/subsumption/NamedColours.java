package io.troupe.services.subsumption;

import java.util.List;
import java.util.Locale;
import java.util.OptionalInt;

/**
 * Named colours as {@code 0x00RRGGBB}: those of the paper, and others that are easy to distinguish. Names and values
 * are those of X11 and of world files.
 */
public final class NamedColours {
    /** State 1, the default. */
    public static final int BLUE = 0x0000FF;
    /** State 2. */
    public static final int RED = 0xFF0000;
    /** State 3. */
    public static final int GREEN = 0x00FF00;
    /** Robot 1. */
    public static final int ORANGE = 0xFFA500;
    /** Robot 2, and the walls. */
    public static final int BLACK = 0x000000;

    /** The largest valid colour. */
    static final int LAST = 0xFFFFFF;

    private record Named(String name, int colour) {}

    private static final List<Named> NAMED = List.of(
            new Named("blue", BLUE),
            new Named("red", RED),
            new Named("green", GREEN),
            new Named("orange", ORANGE),
            new Named("black", BLACK),
            new Named("yellow", 0xFFFF00),
            new Named("cyan", 0x00FFFF),
            new Named("magenta", 0xFF00FF),
            new Named("white", 0xFFFFFF),
            new Named("grey", 0xBEBEBE),
            new Named("gray", 0xBEBEBE),
            new Named("purple", 0xA020F0),
            new Named("violet", 0xEE82EE),
            new Named("brown", 0xA52A2A),
            new Named("pink", 0xFFC0CB),
            new Named("gold", 0xFFD700),
            new Named("navy", 0x000080),
            new Named("turquoise", 0x40E0D0),
            new Named("maroon", 0xB03060),
            new Named("indigo", 0x4B0082),
            new Named("olive", 0x808000),
            new Named("teal", 0x008080),
            new Named("silver", 0xC0C0C0));

    private NamedColours() {}

    /** Returns the colour's name, or {@code #RRGGBB} if it has none. */
    public static String name(int colour) {
        return NAMED.stream()
                .filter(named -> named.colour == colour)
                .map(Named::name)
                .findFirst()
                .orElseGet(() -> hex(colour));
    }

    /** Returns the colour with a name; case is ignored. */
    public static OptionalInt named(String name) {
        String lower = name.toLowerCase(Locale.ROOT);
        return NAMED.stream()
                .filter(named -> named.name.equals(lower))
                .mapToInt(Named::colour)
                .findFirst();
    }

    /** Returns all colour names. */
    public static List<String> names() {
        return NAMED.stream().map(Named::name).toList();
    }

    static String hex(int colour) {
        return String.format(Locale.ROOT, "#%06X", colour);
    }
}
