package io.troupe.services.bus;

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
 * Takes out of a value what its sender could still change: its lists and maps. Refuses what cannot leave a process
 * although its type can: null in a list or a map, and what is nested too deep.
 *
 * <p><b>Cost.</b> Nothing for a record that has no lists, maps or records of its own type, at any depth; else
 * reflection on those that have.
 */
final class Detacher {
    /** How a record is taken apart and put together; null for one that needs neither. */
    private record Plan(List<Method> accessors, Constructor<?> constructor) {}

    private final Map<Class<?>, Optional<Plan>> plans = new ConcurrentHashMap<>();

    /** @throws IllegalArgumentException if it cannot leave the process; the text names its type and says why */
    <T extends Record> T detached(T value) {
        if (planOf(value.getClass()) == null) {
            return value;
        }
        @SuppressWarnings("unchecked") // made by the value's own constructor
        T copy = (T) new Walk(value.getClass()).copyOfRecord(value, 1);
        return copy;
    }

    private @Nullable Plan planOf(Class<?> type) {
        var known = plans.get(type);
        if (known == null) {
            known = mustBeWalked(type, new HashSet<>()) ? Optional.of(plan(type)) : Optional.empty();
            plans.put(type, known);
        }
        return known.orElse(null);
    }

    /** Through one value. */
    private final class Walk {
        private final Class<?> root;

        Walk(Class<?> root) {
            this.root = root;
        }

        /** @param level how many values it is inside of, itself included */
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
                        "a value of " + value.getClass().getName() + " could not be copied for the bus: " + cause,
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
            if (level > Portable.MOST_LEVELS) {
                throw refusal("it is nested deeper than " + Portable.MOST_LEVELS + " levels");
            }
            return level;
        }

        private Optional<?> copyOfOptional(Optional<?> optional, int level) {
            return optional.map(value -> copyOf(value, level + 1));
        }

        /** An immutable list of the platform is its own copy, if its elements are. */
        private List<?> copyOfList(List<?> list, int level) {
            var copy = new ArrayList<Object>(list.size());
            boolean changed = false;
            for (Object each : list) {
                if (each == null) {
                    throw refusal("a list in it has null at " + copy.size());
                }
                Object part = copyOf(each, level + 1);
                copy.add(part);
                changed |= part != each;
            }
            return changed ? List.copyOf(copy) : List.copyOf(list);
        }

        private Map<?, ?> copyOfMap(Map<?, ?> map, int level) {
            var copy = new LinkedHashMap<Object, Object>(); // keeps the order
            for (Map.Entry<?, ?> entry : map.entrySet()) {
                Object key = entry.getKey();
                Object value = entry.getValue();
                if (key == null) {
                    throw refusal("a map in it has the key null");
                }
                if (value == null) {
                    throw refusal("a map in it has null for \"" + key + "\"");
                }
                copy.put(key, copyOf(value, level + 1));
            }
            return Collections.unmodifiableMap(copy);
        }

        private IllegalArgumentException refusal(String why) {
            return new IllegalArgumentException("a value of " + root.getName()
                    + " cannot leave the process: " + why
                    + ", expected values, and no null in lists and maps, in at most "
                    + Portable.MOST_LEVELS + " levels of records, lists and maps");
        }
    }

    /** @param inside the types that this one is a part of */
    private static boolean mustBeWalked(Type type, Set<Type> inside) {
        if (type instanceof ParameterizedType) {
            return true; // List, Map or Optional: see Portable
        }
        if (!(type instanceof Class<?> plain) || !plain.isRecord() && !plain.isSealed()) {
            return false;
        }
        if (!inside.add(plain)) {
            return true; // a value may be as deep as it likes
        }
        boolean must = plain.isRecord()
                ? Arrays.stream(plain.getRecordComponents())
                        .anyMatch(each -> mustBeWalked(each.getGenericType(), inside))
                : Arrays.stream(plain.getPermittedSubclasses()).anyMatch(each -> mustBeWalked(each, inside));
        inside.remove(plain);
        return must;
    }

    private static Plan plan(Class<?> type) {
        var components = type.getRecordComponents();
        var accessors = new ArrayList<Method>();
        try {
            for (RecordComponent component : components) {
                accessors.add(opened(component.getAccessor()));
            }
            var constructor = type.getDeclaredConstructor(
                    Arrays.stream(components).map(RecordComponent::getType).toArray(Class<?>[]::new));
            constructor.setAccessible(true);
            return new Plan(accessors, constructor);
        } catch (NoSuchMethodException impossible) {
            throw new IllegalStateException("a record without its constructor: " + type, impossible);
        }
    }

    private static Method opened(Method accessor) {
        accessor.setAccessible(true); // a record's own class need not be public
        return accessor;
    }
}
