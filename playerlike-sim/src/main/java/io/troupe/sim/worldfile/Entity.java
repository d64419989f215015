package io.troupe.sim.worldfile;

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

    private @Nullable Value value(String key) {
        Property property = properties.get(key);
        return property == null ? null : property.value();
    }
}
