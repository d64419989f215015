package io.troupe.actor;

import java.lang.reflect.Array;
import java.lang.reflect.Field;
import java.lang.reflect.Modifier;
import java.util.ArrayDeque;
import java.util.Collection;
import java.util.Collections;
import java.util.IdentityHashMap;
import java.util.Set;

/** The objects reachable from an object through objects of this library, lambdas, arrays and collections. */
public final class Reachable {
    private final Set<Object> seen = Collections.newSetFromMap(new IdentityHashMap<>());
    private final ArrayDeque<Object> waiting = new ArrayDeque<>();

    private Reachable() {}

    /** All objects reachable from one, including itself. */
    public static Set<Object> from(Object root) {
        var walk = new Reachable();
        walk.add(root);
        for (Object each = walk.waiting.poll(); each != null; each = walk.waiting.poll()) {
            walk.addPartsOf(each);
        }
        return walk.seen;
    }

    private void add(Object object) {
        if (object != null && !(object instanceof Class) && seen.add(object)) {
            waiting.add(object);
        }
    }

    private void addPartsOf(Object object) {
        Class<?> type = object.getClass();
        if (object instanceof Collection<?> collection) {
            collection.forEach(this::add);
        } else if (type.isArray() && !type.getComponentType().isPrimitive()) {
            for (int index = 0; index < Array.getLength(object); index++) {
                add(Array.get(object, index));
            }
        }
        for (Class<?> each = type;
                each != null && each.getName().startsWith("io.troupe.");
                each = each.getSuperclass()) {
            for (Field field : each.getDeclaredFields()) {
                if (!Modifier.isStatic(field.getModifiers()) && !field.getType().isPrimitive()) {
                    field.setAccessible(true);
                    try {
                        add(field.get(object));
                    } catch (IllegalAccessException impossible) {
                        throw new IllegalStateException(impossible);
                    }
                }
            }
        }
    }
}
