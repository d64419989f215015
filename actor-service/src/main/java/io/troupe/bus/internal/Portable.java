package io.troupe.bus.internal;

import java.lang.reflect.ParameterizedType;
import java.lang.reflect.RecordComponent;
import java.lang.reflect.Type;
import java.time.Duration;
import java.time.Instant;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

/**
 * Checks whether records of a type can leave a process: only if they consist of values at every depth.
 *
 * <p><b>Cost.</b> Walks the type once, when a topic or an operation is created.
 */
public final class Portable {
    /**
     * The deepest nesting of values, the value itself included. Low enough for recursive copying, encoding and
     * decoding.
     */
    public static final int MAX_LEVELS = 500;

    private static final Set<Class<?>> VALUES = Set.of(
            Boolean.class,
            Byte.class,
            Short.class,
            Character.class,
            Integer.class,
            Long.class,
            Float.class,
            Double.class,
            String.class,
            Duration.class,
            Instant.class,
            CborItem.class);
    private static final String EXPECTED = "expected primitives and their boxes, String, enums, Duration, Instant,"
            + " records or sealed interfaces of such, or List, Optional or Map<String, ..> of such";

    private final String use; // the begin of a message
    private final String root;
    private final Set<Class<?>> seen = new HashSet<>(); // a record may contain its own type, as a tree does

    private Portable(String use, String root) {
        this.use = use;
        this.root = root;
    }

    /**
     * @throws IllegalArgumentException if values of that type cannot leave the process; the message names the component
     *     and the reason
     */
    public static void check(String use, Class<? extends Record> type) {
        var check = new Portable(
                use + ": values of " + type.getName() + " cannot leave a process because of ", type.getSimpleName());
        if (!type.isRecord()) {
            throw check.rejection("", type, "it is no record");
        }
        check.checkType("", type);
    }

    /**
     * The same for a part of a message, which need not be a record.
     *
     * @throws IllegalArgumentException if values of that type cannot leave the process; the message begins with the
     *     use, and names the component and the reason
     */
    public static void checkValue(String use, Type type) {
        String root = type instanceof Class<?> plain ? plain.getSimpleName() : type.getTypeName();
        new Portable(use + ": ", root).checkType("", type);
    }

    private void checkType(String path, Type type) {
        switch (type) {
            case Class<?> plain -> checkClass(path, plain);
            case ParameterizedType generic -> checkGeneric(path, generic);
            default -> throw rejection(path, type, "it is not known which type that is");
        }
    }

    private void checkClass(String path, Class<?> type) {
        if (type.isPrimitive() || type.isEnum() || VALUES.contains(type)) {
            return;
        }
        if (type.isArray()) {
            throw rejection(path, type, "an array can be changed: use a List");
        }
        if (type.isRecord()) {
            checkRecord(path, type);
        } else if (type.isInterface() && type.isSealed()) {
            if (seen.add(type)) {
                for (Class<?> each : type.getPermittedSubclasses()) {
                    checkType(path + "(" + each.getSimpleName() + ")", each);
                }
            }
        } else if (type == List.class || type == Map.class || type == Optional.class) {
            throw rejection(path, type, "it does not name its element type");
        } else {
            throw rejection(path, type, EXPECTED);
        }
    }

    private void checkRecord(String path, Class<?> type) {
        if (seen.add(type)) {
            for (RecordComponent component : type.getRecordComponents()) {
                checkType(path + "." + component.getName(), component.getGenericType());
            }
        }
    }

    private void checkGeneric(String path, ParameterizedType type) {
        Type[] arguments = type.getActualTypeArguments();
        Type raw = type.getRawType();
        if (raw == List.class || raw == Optional.class) {
            checkType(path + "[]", arguments[0]);
        } else if (raw == Map.class && arguments[0] == String.class) {
            checkType(path + "{}", arguments[1]);
        } else if (raw == Map.class) {
            throw rejection(path, type, "the keys of a Map have to be String");
        } else {
            throw rejection(path, type, EXPECTED);
        }
    }

    private IllegalArgumentException rejection(String path, Type type, String why) {
        return new IllegalArgumentException(use + root + path + " of type " + type.getTypeName() + ": " + why);
    }
}
