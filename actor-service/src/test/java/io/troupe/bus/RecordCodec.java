package io.troupe.bus;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.ObjectInputStream;
import java.io.ObjectOutputStream;
import java.io.Serializable;
import java.lang.reflect.RecordComponent;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** Takes records apart, component by component, to bytes, and back: shows that messages contain nothing else. */
final class RecordCodec {
    private static final Set<Class<?>> NUMBERS =
            Set.of(Byte.class, Short.class, Integer.class, Long.class, Float.class, Double.class);
    private static final Set<Class<?>> OTHERS =
            Set.of(Boolean.class, Character.class, String.class, Duration.class, Instant.class);

    /** What is in a record, an optional value or a map. */
    private record Parts(Class<?> of, ArrayList<@Nullable Object> parts) implements Serializable {}

    private RecordCodec() {}

    static byte[] encode(Record value) {
        var bytes = new ByteArrayOutputStream();
        try (var out = new ObjectOutputStream(bytes)) {
            out.writeObject(apart(value, 0));
        } catch (IOException | ReflectiveOperationException failure) {
            throw new IllegalArgumentException("cannot encode " + value, failure);
        }
        return bytes.toByteArray();
    }

    static Record decode(byte[] bytes) {
        try (var in = new ObjectInputStream(new ByteArrayInputStream(bytes))) {
            return (Record) Objects.requireNonNull(together(in.readObject()));
        } catch (IOException | ReflectiveOperationException failure) {
            throw new IllegalArgumentException("cannot decode", failure);
        }
    }

    /** @param level the nesting depth: at most that of a value plus one for the message around it */
    private static @Nullable Object apart(@Nullable Object value, int level) throws ReflectiveOperationException {
        if (level > Portable.MAX_LEVELS + 1) { // scalars are one level deeper than the last record
            throw new IllegalArgumentException(
                    "a message is nested deeper than " + Portable.MAX_LEVELS + " levels and its value");
        }
        return switch (value) {
            case null -> null;
            case List<?> it -> allApart(it.stream(), level);
            case Optional<?> it -> new Parts(Optional.class, allApart(it.stream(), level));
            case Map<?, ?> it ->
                new Parts(
                        Map.class,
                        allApart(it.entrySet().stream().flatMap(e -> Stream.of(e.getKey(), e.getValue())), level));
            case Record it -> new Parts(it.getClass(), allApart(componentsOf(it).stream(), level));
            case Enum<?> it -> it;
            case Object it when NUMBERS.contains(it.getClass()) || OTHERS.contains(it.getClass()) -> it;
            default -> throw new IllegalArgumentException("a " + value.getClass() + " cannot leave a process");
        };
    }

    private static ArrayList<@Nullable Object> allApart(Stream<?> values, int level)
            throws ReflectiveOperationException {
        var parts = new ArrayList<@Nullable Object>();
        for (Object value : values.toList()) {
            parts.add(apart(value, level + 1));
        }
        return parts;
    }

    private static List<@Nullable Object> componentsOf(Record value) throws ReflectiveOperationException {
        var components = new ArrayList<@Nullable Object>();
        for (RecordComponent component : value.getClass().getRecordComponents()) {
            component.getAccessor().setAccessible(true);
            components.add(component.getAccessor().invoke(value));
        }
        return components;
    }

    private static @Nullable Object together(@Nullable Object value) throws ReflectiveOperationException {
        return switch (value) {
            case List<?> it -> allTogether(it);
            case Parts it
            when it.of == Optional.class -> allTogether(it.parts).stream().findFirst();
            case Parts it
            when it.of == Map.class -> {
                var map = new LinkedHashMap<@Nullable Object, @Nullable Object>();
                for (var parts = allTogether(it.parts).iterator(); parts.hasNext(); ) {
                    map.put(parts.next(), parts.next());
                }
                yield map;
            }
            case Parts it -> {
                var types = Stream.of(it.of.getRecordComponents()).map(RecordComponent::getType);
                var constructor = it.of.getDeclaredConstructor(types.toArray(Class<?>[]::new));
                constructor.setAccessible(true);
                yield constructor.newInstance(allTogether(it.parts).toArray());
            }
            case null, default -> value;
        };
    }

    private static List<@Nullable Object> allTogether(List<?> parts) throws ReflectiveOperationException {
        var values = new ArrayList<@Nullable Object>();
        for (Object part : parts) {
            values.add(together(part));
        }
        return values;
    }
}
