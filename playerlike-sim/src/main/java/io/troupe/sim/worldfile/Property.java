package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;

/**
 * A name and its value: {@code size [1 2 3]}, {@code point[0] [0 1]}, {@code polygon[0].point[1] [0 1]} whose name is
 * {@code polygon[0].point}.
 *
 * @param index the number in brackets after the name, {@link #NO_INDEX} if there is none
 */
record Property(String name, int index, Value value, SourcePosition where) {
    static final int NO_INDEX = -1;

    /** Unique key of the property within its entity; elements of an array differ. */
    String key() {
        return key(name, index);
    }

    /** Number of numbers or texts in the value; an empty tuple counts as one. */
    int valueCount() {
        return value instanceof Value.Tuple tuple ? Math.max(1, tuple.items().size()) : 1;
    }

    /** The name in the {@link Vocabulary}: {@code polygon.points} for {@code polygon[0].points}. */
    String word() {
        int bracket = name.indexOf('[');
        return bracket < 0 ? name : name.substring(0, bracket) + name.substring(name.indexOf(']') + 1);
    }

    static String key(String name, int index) {
        return index == NO_INDEX ? name : name + "[" + index + "]";
    }
}
