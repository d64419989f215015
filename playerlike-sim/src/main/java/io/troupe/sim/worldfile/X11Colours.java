package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.Suggestions;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.Collections;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.TreeMap;

/** Colour names of X11 and CSS; case and spaces do not matter. */
final class X11Colours {
    private static final Map<String, Integer> BY_NAME = load();

    private X11Colours() {}

    /** The colour with a name, {@code 0x00RRGGBB}. */
    static int named(String name, SourcePosition where) {
        Integer colour = BY_NAME.get(name.toLowerCase(Locale.ROOT).replace(" ", ""));
        if (colour == null) {
            String meant = Suggestions.clause(name, BY_NAME.keySet());
            throw new WorldFileException(
                    where,
                    "unknown colour \"" + name + '"'
                            + (meant.isEmpty() ? "; expected a colour name of X11, such as \"red\"" : meant));
        }
        return colour;
    }

    /**
     * The colour of an entity; the default is red. {@code "random"} is a colour that depends on the position of the
     * entity in the file. If both a name and {@code color_rgba} are given, the last one counts.
     */
    static int of(Entity entity) {
        int colour = 0xff0000;
        for (Property property : entity.properties().values()) {
            if (property.name().equals("color")) {
                String name = entity.text("color", "");
                colour = name.equalsIgnoreCase("random")
                        ? drawn(entity.where())
                        : named(name, property.value().where());
            } else if (property.name().equals("color_rgba")) {
                colour = mixed(entity.numbers("color_rgba"), property.value().where());
            }
        }
        return colour;
    }

    /** A different colour for every position in a file; the same in every run. */
    private static int drawn(SourcePosition where) {
        long bits = 0x9E3779B97F4A7C15L * (31L * where.line() + where.column());
        bits = (bits ^ bits >>> 32) * 0xD6E8FEB86659FD93L;
        return (int) (bits >>> 40);
    }

    private static int mixed(double[] rgba, SourcePosition where) {
        int colour = 0;
        for (int i = 0; i < 4; i++) {
            if (rgba[i] < 0 || rgba[i] > 1) {
                throw new WorldFileException(where, "\"color_rgba\" must be four shares from 0 to 1, not " + rgba[i]);
            }
            if (i < 3) {
                colour = colour << 8 | (int) StrictMath.rint(rgba[i] * 255);
            }
        }
        return colour;
    }

    /** All names in lower case without spaces, with their colours. */
    static Map<String, Integer> byName() {
        return Collections.unmodifiableMap(BY_NAME);
    }

    private static Map<String, Integer> load() {
        var colours = new TreeMap<String, Integer>();
        var resource =
                Objects.requireNonNull(X11Colours.class.getResourceAsStream("x11-colours.txt"), "x11-colours.txt");
        try (var lines = new BufferedReader(new InputStreamReader(resource, StandardCharsets.UTF_8))) {
            lines.lines().filter(line -> !line.startsWith("#")).forEach(line -> {
                String[] valueAndName = line.split(" ", 2);
                colours.put(valueAndName[1], Integer.parseInt(valueAndName[0], 16));
            });
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        return colours;
    }
}
