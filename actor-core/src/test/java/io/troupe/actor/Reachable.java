package io.troupe.actor;

import java.lang.reflect.Field;
import java.lang.reflect.Modifier;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collection;
import java.util.Collections;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Set;

/** The objects reachable from an object through objects of this library, lambdas, arrays and collections. */
public final class Reachable {
    private Reachable() {}

    /** All objects reachable from one, including itself. */
    public static Set<Object> from(Object root) {
        Set<Object> seen = Collections.newSetFromMap(new IdentityHashMap<>());
        var waiting = new ArrayDeque<Object>(List.of(root));
        for (Object each = waiting.poll(); each != null; each = waiting.poll()) {
            if (seen.add(each)) {
                waiting.addAll(partsOf(each));
            }
        }
        return seen;
    }

    private static List<Object> partsOf(Object object) {
        var parts = new ArrayList<Object>();
        if (object instanceof Collection<?> collection) {
            parts.addAll(collection);
        } else if (object instanceof Object[] array) {
            parts.addAll(Arrays.asList(array));
        }
        Class<?> type = object.getClass();
        for (; type != null && type.getName().startsWith("io.troupe."); type = type.getSuperclass()) {
            for (Field field : type.getDeclaredFields()) {
                if (!Modifier.isStatic(field.getModifiers()) && !field.getType().isPrimitive()) {
                    field.setAccessible(true);
                    try {
                        parts.add(field.get(object));
                    } catch (IllegalAccessException impossible) {
                        throw new IllegalStateException(impossible);
                    }
                }
            }
        }
        parts.removeIf(part -> part == null || part instanceof Class);
        return parts;
    }
}
