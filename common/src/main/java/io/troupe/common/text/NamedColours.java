package io.troupe.common.text;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.Collections;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.OptionalInt;
import java.util.TreeMap;

/**
 * Colours by their names in X11 and CSS, as {@code 0x00RRGGBB}. World files know all of them ({@link #byName}). Tables
 * know those of the paper and others that are easy to distinguish ({@link #names}).
 */
public final class NamedColours {
    public static final int BLUE = 0x0000FF;
    public static final int RED = 0xFF0000;
    /** Green of X11; CSS calls it lime. */
    public static final int GREEN = 0x00FF00;

    public static final int ORANGE = 0xFFA500;
    public static final int BLACK = 0x000000;

    /** The largest valid colour. */
    public static final int LAST = 0xFFFFFF;

    private static final Map<String, Integer> BY_NAME = Collections.unmodifiableMap(load("x11-colours.txt"));

    private static final List<String> NAMES = List.of(
            "blue",
            "red",
            "green",
            "orange",
            "black",
            "yellow",
            "cyan",
            "magenta",
            "white",
            "grey",
            "gray",
            "purple",
            "violet",
            "brown",
            "pink",
            "gold",
            "navy",
            "turquoise",
            "maroon",
            "indigo",
            "olive",
            "teal",
            "silver");

    private NamedColours() {}

    /** Returns the colour's name, one of {@link #names}, or {@code #RRGGBB} if it has none. */
    public static String name(int colour) {
        return NAMES.stream()
                .filter(name -> BY_NAME.get(name) == colour)
                .findFirst()
                .orElseGet(() -> hex(colour));
    }

    /** Returns the colour with a name of {@link #names}; case is ignored. */
    public static OptionalInt named(String name) {
        String lower = name.toLowerCase(Locale.ROOT);
        return NAMES.contains(lower) ? OptionalInt.of(BY_NAME.get(lower)) : OptionalInt.empty();
    }

    /** Returns the names of colours that are easy to distinguish. */
    public static List<String> names() {
        return NAMES;
    }

    /** Returns the colour with any name of X11 or CSS; case and spaces are ignored. */
    public static OptionalInt namedInX11(String name) {
        Integer colour = BY_NAME.get(name.toLowerCase(Locale.ROOT).replace(" ", ""));
        return colour == null ? OptionalInt.empty() : OptionalInt.of(colour);
    }

    /** Returns all names of X11 and CSS in lower case without spaces, sorted, with their colours. */
    public static Map<String, Integer> byName() {
        return BY_NAME;
    }

    /** Returns {@code #RRGGBB}. */
    public static String hex(int colour) {
        return String.format(Locale.ROOT, "#%06X", colour);
    }

    private static Map<String, Integer> load(String resource) {
        var colours = new TreeMap<String, Integer>();
        var stream = Objects.requireNonNull(NamedColours.class.getResourceAsStream(resource), resource);
        try (var lines = new BufferedReader(new InputStreamReader(stream, StandardCharsets.UTF_8))) {
            for (String line = lines.readLine(); line != null; line = lines.readLine()) {
                if (!line.startsWith("#")) {
                    int space = line.indexOf(' ');
                    colours.put(line.substring(space + 1), Integer.parseInt(line, 0, space, 16));
                }
            }
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        return colours;
    }
}
