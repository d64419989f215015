package io.troupe.bus.internal;

import java.lang.reflect.Constructor;
import java.lang.reflect.Method;
import java.lang.reflect.ParameterizedType;
import java.lang.reflect.RecordComponent;
import java.lang.reflect.Type;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import org.jspecify.annotations.Nullable;

/**
 * Copies a record so that its sender can no longer change it: lists and maps are replaced by immutable copies. Rejects
 * values that cannot leave the process although their type can: null in a list or a map, or too many levels of nesting.
 *
 * <p><b>Cost.</b> None for a record type that contains, at any depth, no list, no map and no nested record of the same
 * type. Otherwise reflection on the records that contain them.
 */
public final class RecordCopier {
    /** Accessors and constructor of a record type that has to be copied. */
    private record Plan(List<Method> accessors, Constructor<?> constructor) {}

    private static final int PART_LEVEL = 3; // in a message, in its list of arguments

    private final Map<Class<?>, Optional<Plan>> plans = new ConcurrentHashMap<>();

    /**
     * Returns the value itself if it needs no copy.
     *
     * @throws IllegalArgumentException if it cannot leave the process; the message names its type and the reason
     */
    public <T extends Record> T copy(T value) {
        if (planOf(value.getClass()) == null) {
            return value;
        }
        @SuppressWarnings("unchecked") // the constructor of the value's class made it
        T copy = (T) new Copying(value.getClass()).copyOfRecord(value, 1);
        return copy;
    }

    /**
     * The same for a value that is a part of a message, of any type that {@link Portable#checkValue} permits.
     *
     * @throws IllegalArgumentException if it cannot leave the process; the message names its type and the reason
     */
    public Object copyOfPart(Object value) {
        return new Copying(value.getClass()).copyOf(value, PART_LEVEL);
    }

    private @Nullable Plan planOf(Class<?> type) {
        var known = plans.get(type);
        if (known == null) {
            known = mayNeedCopy(type, new HashSet<>()) ? Optional.of(plan(type)) : Optional.empty();
            plans.put(type, known);
        }
        return known.orElse(null);
    }

    /** The copying of one value. */
    private final class Copying {
        private final Class<?> root;

        Copying(Class<?> root) {
            this.root = root;
        }

        /** @param level the nesting depth of the value; the root has level 1 */
        Object copyOfRecord(Record value, int level) {
            Plan plan = planOf(value.getClass());
            if (plan == null) {
                return value;
            }
            var parts = new Object[plan.accessors().size()];
            boolean changed = false;
            try {
                for (int i = 0; i < parts.length; i++) {
                    Object part = plan.accessors().get(i).invoke(value);
                    parts[i] = part == null ? null : copyOf(part, level + 1);
                    changed |= parts[i] != part;
                }
                return changed ? plan.constructor().newInstance(parts) : value;
            } catch (ReflectiveOperationException failure) {
                Throwable cause = failure.getCause() == null ? failure : failure.getCause();
                throw new IllegalArgumentException(
                        "a value of " + value.getClass().getName() + " could not be copied for the bus: "
                                + BoundedText.of(cause),
                        cause);
            }
        }

        private Object copyOf(Object part, int level) {
            return switch (part) {
                case List<?> list -> copyOfList(list, checked(level));
                case Map<?, ?> map -> copyOfMap(map, checked(level));
                case Optional<?> optional -> copyOfOptional(optional, checked(level));
                case Record inner -> copyOfRecord(inner, checked(level));
                default -> part;
            };
        }

        private int checked(int level) {
            if (level > Portable.MAX_LEVELS) {
                throw rejection("it is nested deeper than " + Portable.MAX_LEVELS + " levels");
            }
            return level;
        }

        private Optional<?> copyOfOptional(Optional<?> optional, int level) {
            return optional.map(value -> copyOf(value, level + 1));
        }

        /** An immutable list of the JDK is returned as it is if its elements need no copy. */
        private List<?> copyOfList(List<?> list, int level) {
            List<Object> copy = null; // made when the first element needs one
            int index = 0;
            for (Object each : list) {
                if (each == null) {
                    throw rejection("a list in it has null at " + index);
                }
                Object part = copyOf(each, level + 1);
                if (copy == null && part != each) {
                    copy = new ArrayList<>(list.subList(0, index));
                }
                if (copy != null) {
                    copy.add(part);
                }
                index++;
            }
            return List.copyOf(copy == null ? list : copy);
        }

        private Map<?, ?> copyOfMap(Map<?, ?> map, int level) {
            var copy = new LinkedHashMap<Object, Object>(); // keeps the iteration order
            for (Map.Entry<?, ?> entry : map.entrySet()) {
                Object key = entry.getKey();
                Object value = entry.getValue();
                if (key == null) {
                    throw rejection("a map in it has the key null");
                }
                if (value == null) {
                    throw rejection("a map in it has null for \"" + key + "\"");
                }
                copy.put(key, copyOf(value, level + 1));
            }
            return Collections.unmodifiableMap(copy);
        }

        private IllegalArgumentException rejection(String why) {
            return new IllegalArgumentException("a value of " + root.getName()
                    + " cannot leave the process: " + why
                    + ", expected values, and no null in lists and maps, in at most "
                    + Portable.MAX_LEVELS + " levels of records, lists and maps");
        }
    }

    /**
     * Returns whether values of the type may need a copy.
     *
     * @param inside the types that contain this one
     */
    private static boolean mayNeedCopy(Type type, Set<Type> inside) {
        if (type instanceof ParameterizedType) {
            return true; // List, Map or Optional: see Portable
        }
        if (!(type instanceof Class<?> plain) || !plain.isRecord() && !plain.isSealed()) {
            return false;
        }
        if (!inside.add(plain)) {
            return true; // recursive type: a value may have any depth
        }
        boolean must = plain.isRecord()
                ? Arrays.stream(plain.getRecordComponents())
                        .anyMatch(each -> mayNeedCopy(each.getGenericType(), inside))
                : Arrays.stream(plain.getPermittedSubclasses()).anyMatch(each -> mayNeedCopy(each, inside));
        inside.remove(plain);
        return must;
    }

    private static Plan plan(Class<?> type) {
        var components = type.getRecordComponents();
        var accessors = new ArrayList<Method>();
        try {
            for (RecordComponent component : components) {
                accessors.add(accessible(component.getAccessor()));
            }
            var constructor = type.getDeclaredConstructor(
                    Arrays.stream(components).map(RecordComponent::getType).toArray(Class<?>[]::new));
            constructor.setAccessible(true);
            return new Plan(accessors, constructor);
        } catch (NoSuchMethodException impossible) {
            throw new IllegalStateException("a record without its constructor: " + type, impossible);
        }
    }

    private static Method accessible(Method accessor) {
        accessor.setAccessible(true); // the class of the record need not be public
        return accessor;
    }
}
