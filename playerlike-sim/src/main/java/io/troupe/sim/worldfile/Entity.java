package io.troupe.sim.worldfile;

import io.troupe.common.text.NamedColours;
import io.troupe.common.text.SourcePosition;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/**
 * A node of the file's tree, macros expanded: {@code type ( properties and children )}.
 *
 * <p>The typed accessors may be used only after {@link VocabularyCheck}: they rely on values of the right kind.
 *
 * @param properties by {@link Property#key()}, immutable; a property given twice is at its last position
 * @param weight number of entities in this subtree
 * @param values number of numbers and texts in the properties of this subtree
 * @param depth nesting depth of this subtree
 */
record Entity(
        String type,
        SourcePosition where,
        Map<String, Property> properties,
        List<Entity> children,
        long weight,
        long values,
        int depth) {
    Entity {
        children = List.copyOf(children);
    }

    boolean has(String key) {
        return properties.containsKey(key);
    }

    /** Position of the property's value, or of the entity itself if the property is not given. */
    SourcePosition whereOf(String key) {
        Property property = properties.get(key);
        return property == null ? where : property.value().where();
    }

    double number(String key, double otherwise) {
        return value(key) instanceof Value.Num number ? number.value() : otherwise;
    }

    int whole(String key, int otherwise) {
        return (int) number(key, otherwise);
    }

    boolean flag(String key, boolean otherwise) {
        return number(key, otherwise ? 1 : 0) != 0;
    }

    String text(String key, String otherwise) {
        return value(key) instanceof Value.Text text ? text.text() : otherwise;
    }

    double[] numbers(String key, double... otherwise) {
        return value(key) instanceof Value.Tuple tuple
                ? tuple.items().stream()
                        .mapToDouble(item -> ((Value.Num) item).value())
                        .toArray()
                : otherwise;
    }

    List<Value.Text> texts(String key) {
        return value(key) instanceof Value.Tuple tuple
                ? tuple.items().stream().map(Value.Text.class::cast).toList()
                : List.of();
    }

    /**
     * The colour of the entity, {@code 0x00RRGGBB}; the default is red. {@code "random"} is a colour that depends on
     * the position of the entity in the file. If both a name and {@code color_rgba} are given, the last one counts.
     */
    int colour() {
        int colour = NamedColours.RED;
        for (Property property : properties.values()) {
            if (property.value() instanceof Value.Text name && property.name().equals("color")) {
                colour = name.text().equalsIgnoreCase("random") ? drawnColour() : name.colour();
            } else if (property.name().equals("color_rgba")) {
                colour = mixed(numbers("color_rgba"), property.value().where());
            }
        }
        return colour;
    }

    /** A different colour for every position in a file; the same in every run. */
    private int drawnColour() {
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

    private @Nullable Value value(String key) {
        Property property = properties.get(key);
        return property == null ? null : property.value();
    }
}
