package io.troupe.sim.worldfile;

import io.troupe.common.text.NamedColours;
import io.troupe.common.text.SourcePosition;
import java.util.AbstractMap;
import java.util.AbstractSet;
import java.util.ArrayList;
import java.util.Collections;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;
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
        return value(key) instanceof Value.Tuple tuple && tuple.items().stream().allMatch(Value.Num.class::isInstance)
                ? tuple.items().stream()
                        .mapToDouble(item -> ((Value.Num) item).value())
                        .toArray()
                : otherwise;
    }

    List<Value.Text> texts(String key) {
        return value(key) instanceof Value.Tuple tuple && tuple.items().stream().allMatch(Value.Text.class::isInstance)
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

    /** This entity with other properties and children. */
    Entity with(Map<String, Property> others, List<Entity> otherChildren) {
        return new Entity(type, where, others, otherChildren, weight, values, depth);
    }

    private @Nullable Value value(String key) {
        Property property = properties.get(key);
        return property == null ? null : property.value();
    }

    /** Collects the properties and children of an entity, starting from those of its macro. */
    static final class Builder {
        /** Limit for nested macros, which grow exponentially; real worlds are far below. */
        static final long MOST_ENTITIES = 100_000;

        /**
         * Limit of values. Those of a macro count in each use of it, because all of them are checked and converted to
         * shapes.
         */
        static final long MOST_VALUES = 5_000_000;

        /** Limit of nesting. Macros that contain macros nest deeper than the text does. */
        private static final int DEEPEST_NESTING = 100;

        private final String type;
        private final SourcePosition where;
        private final Diagnostics diagnostics;
        private final Map<String, Property> inherited; // shared with the macro and its other instances
        private final Map<String, Property> own = new LinkedHashMap<>();
        private final List<Entity> children = new ArrayList<>();
        private long weight = 1;
        private long childValues;
        private int depth = 1;

        Builder(String word, @Nullable Entity macro, SourcePosition where, Diagnostics diagnostics) {
            this.type = macro == null ? word : macro.type();
            this.where = where;
            this.diagnostics = diagnostics;
            this.inherited = macro == null ? Map.of() : macro.properties();
            if (macro != null) {
                macro.children().forEach(this::add);
            }
        }

        void add(Property property) {
            Property earlier = own.remove(property.key());
            own.put(property.key(), property);
            // the same position twice: a file that was included twice
            if (earlier != null && !earlier.where().equals(property.where())) {
                diagnostics.warn(
                        property.where(),
                        "\"" + property.key() + "\" is given twice, the first time at " + earlier.where()
                                + ", and the last counts");
            }
        }

        void add(Entity child) {
            weight += child.weight();
            if (weight > MOST_ENTITIES) {
                throw new WorldFileException(child.where(), "more than " + MOST_ENTITIES + " entities in one file");
            }
            childValues += child.values();
            if (childValues > MOST_VALUES) {
                throw new WorldFileException(
                        child.where(),
                        "more than " + MOST_VALUES + " values in one file; those of a macro count in each use of it");
            }
            depth = Math.max(depth, child.depth() + 1);
            if (depth > DEEPEST_NESTING) {
                throw new WorldFileException(child.where(), "entities are nested deeper than " + DEEPEST_NESTING);
            }
            children.add(child);
        }

        Entity build() {
            return entity(inherited.isEmpty() ? Collections.unmodifiableMap(own) : new Layers(inherited, own));
        }

        /**
         * Builds a macro, with a flat table of properties: instances of a macro of a macro then search two tables, not
         * many.
         */
        Entity buildMacro() {
            var all = new LinkedHashMap<>(inherited);
            all.keySet().removeAll(own.keySet());
            all.putAll(own);
            return entity(Collections.unmodifiableMap(all));
        }

        private Entity entity(Map<String, Property> properties) {
            long values = childValues;
            for (Property property : properties.values()) {
                values += property.valueCount();
            }
            return new Entity(type, where, properties, children, weight, values, depth);
        }

        /** The properties of an instance: those of its macro that it does not override, then its own. */
        private static final class Layers extends AbstractMap<String, Property> {
            private final Map<String, Property> inherited;
            private final Map<String, Property> own;

            Layers(Map<String, Property> inherited, Map<String, Property> own) {
                this.inherited = inherited;
                this.own = own;
            }

            @Override
            public @Nullable Property get(Object key) {
                Property property = own.get(key);
                return property != null ? property : inherited.get(key);
            }

            @Override
            public boolean containsKey(Object key) {
                return own.containsKey(key) || inherited.containsKey(key);
            }

            @Override
            public Set<Entry<String, Property>> entrySet() {
                return new AbstractSet<>() {
                    @Override
                    public Iterator<Entry<String, Property>> iterator() {
                        return Stream.concat(
                                        inherited.entrySet().stream().filter(each -> !own.containsKey(each.getKey())),
                                        own.entrySet().stream())
                                .iterator();
                    }

                    @Override
                    public int size() {
                        return own.size()
                                + (int) inherited.keySet().stream()
                                        .filter(key -> !own.containsKey(key))
                                        .count();
                    }
                };
            }
        }
    }
}
