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
 * Takes out of a value what its sender could still change: its lists and maps.
 *
 * <p><b>Cost.</b> Nothing for a record that has neither, at any depth; else reflection on those that have.
 */
final class Detacher {
    /** How a record is taken apart and put together; null for one that needs neither. */
    private record Plan(List<Method> accessors, Constructor<?> constructor) {}

    private final Map<Class<?>, Optional<Plan>> plans = new ConcurrentHashMap<>();

    <T extends Record> T detached(T value) {
        Plan plan = planOf(value.getClass());
        if (plan == null) {
            return value;
        }
        @SuppressWarnings("unchecked") // made by the value's own constructor
        T copy = (T) copyOf(value, plan);
        return copy;
    }

    private @Nullable Plan planOf(Class<?> type) {
        var known = plans.get(type);
        if (known == null) {
            known = hasContainers(type, new HashSet<>()) ? Optional.of(plan(type)) : Optional.empty();
            plans.put(type, known);
        }
        return known.orElse(null);
    }

    private Object copyOf(Record value, Plan plan) {
        var parts = new Object[plan.accessors().size()];
        boolean changed = false;
        try {
            for (int i = 0; i < parts.length; i++) {
                Object part = plan.accessors().get(i).invoke(value);
                parts[i] = copyOf(part);
                changed |= parts[i] != part;
            }
            return changed ? plan.constructor().newInstance(parts) : value;
        } catch (ReflectiveOperationException failure) {
            Throwable cause = failure.getCause() == null ? failure : failure.getCause();
            throw new IllegalArgumentException(
                    "a value of " + value.getClass().getName() + " could not be copied for the bus: " + cause, cause);
        }
    }

    private @Nullable Object copyOf(@Nullable Object part) {
        return switch (part) {
            case null -> null;
            case List<?> list -> copyOfList(list);
            case Map<?, ?> map -> {
                var copy = new LinkedHashMap<Object, @Nullable Object>(); // keeps the order
                map.forEach((key, each) -> copy.put(key, copyOf(each)));
                yield Collections.unmodifiableMap(copy);
            }
            case Optional<?> optional -> optional.map(this::copyOf);
            case Record inner -> detached(inner);
            default -> part;
        };
    }

    /** An immutable list of the platform is its own copy, if its elements are. */
    private List<?> copyOfList(List<?> list) {
        var copy = new ArrayList<Object>(list.size());
        boolean changed = false;
        for (Object each : list) {
            Object part = copyOf(each);
            if (part == null) {
                throw new IllegalArgumentException("a list has null at " + copy.size() + ", expected values: " + list);
            }
            copy.add(part);
            changed |= part != each;
        }
        return changed ? List.copyOf(copy) : List.copyOf(list);
    }

    private static boolean hasContainers(Type type, Set<Type> seen) {
        if (type instanceof ParameterizedType) {
            return true; // List, Map or Optional: see Portable
        }
        if (!(type instanceof Class<?> plain) || !seen.add(plain)) {
            return false;
        }
        if (plain.isRecord()) {
            return Arrays.stream(plain.getRecordComponents())
                    .anyMatch(each -> hasContainers(each.getGenericType(), seen));
        }
        return plain.isSealed()
                && Arrays.stream(plain.getPermittedSubclasses()).anyMatch(each -> hasContainers(each, seen));
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
