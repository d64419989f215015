package io.troupe.bus.internal;

import java.lang.invoke.MethodHandle;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.MethodType;
import java.lang.reflect.Constructor;
import java.lang.reflect.InaccessibleObjectException;
import java.lang.reflect.Method;
import java.lang.reflect.ParameterizedType;
import java.lang.reflect.RecordComponent;
import java.lang.reflect.Type;
import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.ConcurrentHashMap;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/**
 * Encodes values as CBOR (RFC 8949), and decodes them by the type that the receiver expects.
 *
 * <p><b>Units and shapes.</b> The types are those that {@link Portable} permits. A record is a map from the names of
 * its components to their values, in the order of their declaration; null is null. Numbers and texts are those of CBOR,
 * a char is its UTF-16 number, an enum constant its name, a list an array, a map a map, an empty Optional null, and any
 * other Optional its value. Duration and Instant are [seconds, nanoseconds]. The value of a sealed interface is [simple
 * name of its class, value]. No class name crosses the bus: the simple name only selects among the permitted classes of
 * the type that the receiver expects.
 *
 * <p><b>Versions.</b> A reader skips entries that its record does not have, and rejects a value that lacks one, except
 * that an Optional may be missing: then it is empty.
 *
 * <p><b>Threads.</b> Any thread. <b>Cost.</b> A type is analysed once, at its first use, and its plan is kept as long
 * as this codec.
 *
 * <p><b>Errors.</b> Bytes of any content lead to a value or to an {@link UnreadableException}; neither time nor memory
 * exceeds a multiple of their number. If the constructor of a record rejects its values, that is an
 * {@link UnreadableException} too.
 */
public final class RecordCodec {
    private static final int EXPECTED_SIZE = 256;
    private static final int FEW_ELEMENTS = 64;
    private static final Object MISSING = new Object();

    private final Map<Type, Plan> plans = new ConcurrentHashMap<>();
    private final ClassValue<Plan> ofClasses = new ClassValue<>() { // found faster than in the map
                @Override
                protected Plan computeValue(Class<?> type) {
                    Plan known = plans.get(type);
                    return known != null ? known : new Planning().of(type);
                }
            };

    /** How values of one type are written and read. */
    interface Plan {
        void write(Object value, CborWriter out) throws Throwable;

        Object read(CborReader in) throws Throwable;

        /** True if this may write a value as null, so that an Optional of it needs a wrapping. */
        default boolean mayBeNull() {
            return false;
        }
    }

    /** @throws IllegalArgumentException if the value has parts that cannot be encoded */
    public byte[] encode(Record value) {
        var out = new CborWriter(EXPECTED_SIZE);
        write(value.getClass(), value, out);
        return out.toBytes();
    }

    /** @throws UnreadableException if the bytes are no value of the type */
    public <T extends Record> T decode(byte[] bytes, Class<T> type) {
        var in = new CborReader(bytes);
        T value = type.cast(read(type, in));
        in.expectEnd();
        return value;
    }

    /** Appends a value. */
    public void write(Type type, Object value, CborWriter out) {
        try {
            plan(type).write(value, out);
        } catch (RuntimeException | Error failure) {
            throw failure;
        } catch (Throwable thrown) { // of an accessor of a record
            throw new IllegalArgumentException(
                    "a value of " + type.getTypeName() + " could not be encoded: " + BoundedText.of(thrown), thrown);
        }
    }

    /** Reads the next value. */
    public Object read(Type type, CborReader in) {
        try {
            return plan(type).read(in);
        } catch (UnreadableException unreadable) {
            throw unreadable.in(simpleName(type));
        } catch (RuntimeException | Error failure) {
            throw failure;
        } catch (Throwable thrown) {
            throw new UnreadableException(BoundedText.of(thrown)).in(simpleName(type));
        }
    }

    /**
     * Makes the plan of a type before its first value.
     *
     * @throws IllegalArgumentException if its values cannot be encoded
     */
    public void prepare(Type type) {
        plan(type);
    }

    private static String simpleName(Type type) {
        return type instanceof Class<?> plain ? plain.getSimpleName() : type.getTypeName();
    }

    /**
     * The plan of a type, made at its first use.
     *
     * @throws IllegalArgumentException if two permitted classes of a sealed interface have one simple name
     */
    Plan plan(Type type) {
        if (type instanceof Class<?> plain) {
            return ofClasses.get(plain);
        }
        Plan known = plans.get(type);
        return known != null ? known : new Planning().of(type);
    }

    /** Makes the plans of one type and of the types inside it, which may contain each other. */
    private final class Planning {
        private final Map<Type, Plan> made = new HashMap<>();

        Plan of(Type type) {
            Plan plan = make(type);
            plans.putAll(made);
            return plan;
        }

        private Plan make(Type type) {
            Plan known = plans.get(type);
            if (known == null) {
                known = made.get(type);
            }
            if (known != null) {
                return known;
            }
            if (type instanceof ParameterizedType generic) {
                Type[] arguments = generic.getActualTypeArguments();
                Type raw = generic.getRawType();
                return keep(
                        type,
                        raw == List.class
                                ? new ListPlan(make(arguments[0]))
                                : raw == Optional.class
                                        ? new OptionalPlan(make(arguments[0]))
                                        : new MapPlan(make(arguments[1])));
            }
            var plain = (Class<?>) type;
            Plan simple = SIMPLE.get(plain);
            if (simple != null) {
                return keep(type, simple);
            }
            if (plain.isEnum()) {
                return keep(type, new EnumPlan(plain));
            }
            if (plain.isRecord()) {
                var plan = new RecordPlan(plain);
                made.put(type, plan); // before its components, which may contain it
                plan.parts = parts(plain);
                return plan;
            }
            if (plain.isSealed()) {
                var plan = new SealedPlan(plain);
                made.put(type, plan);
                addPermitted(plain, plan);
                return plan;
            }
            throw new IllegalArgumentException("no values of " + type.getTypeName() + " can be encoded");
        }

        private Plan keep(Type type, Plan plan) {
            made.put(type, plan);
            return plan;
        }

        private Part[] parts(Class<?> type) {
            var components = type.getRecordComponents();
            var parts = new Part[components.length];
            for (int i = 0; i < parts.length; i++) {
                parts[i] = new Part(components[i], make(components[i].getGenericType()));
            }
            return parts;
        }

        private void addPermitted(Class<?> sealed, SealedPlan plan) {
            for (Class<?> each : sealed.getPermittedSubclasses()) {
                if (each.isSealed()) {
                    addPermitted(each, plan);
                } else {
                    plan.add(each, make(each));
                }
            }
        }
    }

    // ---- simple values

    private interface Writing {
        void write(Object value, CborWriter out);
    }

    /** In one class, because lists of them are frequent. */
    private static final class DoublePlan implements Plan {
        @Override
        public void write(Object value, CborWriter out) {
            out.writeDouble((Double) value);
        }

        @Override
        public Object read(CborReader in) {
            return in.readDouble();
        }
    }

    private record SimplePlan(Writing writing, Function<CborReader, Object> reading) implements Plan {
        @Override
        public void write(Object value, CborWriter out) {
            writing.write(value, out);
        }

        @Override
        public Object read(CborReader in) {
            return reading.apply(in);
        }
    }

    private static final Map<Class<?>, Plan> SIMPLE = simplePlans();

    private static Map<Class<?>, Plan> simplePlans() {
        var plans = new HashMap<Class<?>, Plan>();
        var doubles = new DoublePlan();
        plans.put(double.class, doubles);
        plans.put(Double.class, doubles);
        both(plans, float.class, Float.class, (v, out) -> out.writeFloat((Float) v), in -> (float) in.readDouble());
        both(
                plans,
                long.class,
                Long.class,
                (v, out) -> out.writeLong((Long) v),
                in -> in.readLong(Long.MIN_VALUE, Long.MAX_VALUE));
        both(plans, int.class, Integer.class, (v, out) -> out.writeLong((Integer) v), in ->
                (int) in.readLong(Integer.MIN_VALUE, Integer.MAX_VALUE));
        both(plans, short.class, Short.class, (v, out) -> out.writeLong((Short) v), in ->
                (short) in.readLong(Short.MIN_VALUE, Short.MAX_VALUE));
        both(plans, byte.class, Byte.class, (v, out) -> out.writeLong((Byte) v), in ->
                (byte) in.readLong(Byte.MIN_VALUE, Byte.MAX_VALUE));
        both(plans, char.class, Character.class, (v, out) -> out.writeLong((Character) v), in ->
                (char) in.readLong(0, Character.MAX_VALUE));
        both(plans, boolean.class, Boolean.class, (v, out) -> out.writeBoolean((Boolean) v), CborReader::readBoolean);
        plans.put(String.class, new SimplePlan((v, out) -> out.writeText((String) v), CborReader::readText));
        plans.put(
                Duration.class,
                new SimplePlan(
                        (v, out) -> writeTime(((Duration) v).getSeconds(), ((Duration) v).getNano(), out),
                        in -> Duration.ofSeconds(readSeconds(in), readNanos(in))));
        plans.put(
                Instant.class,
                new SimplePlan(
                        (v, out) -> writeTime(((Instant) v).getEpochSecond(), ((Instant) v).getNano(), out),
                        in -> instant(readSeconds(in), readNanos(in))));
        plans.put(CborItem.class, new ItemPlan());
        return Map.copyOf(plans);
    }

    /** An item that has been encoded already, and is decoded later. */
    private static final class ItemPlan implements Plan {
        @Override
        public void write(Object value, CborWriter out) {
            ((CborItem) value).writeTo(out);
        }

        @Override
        public Object read(CborReader in) {
            return CborItem.readFrom(in);
        }

        @Override
        public boolean mayBeNull() {
            return true;
        }
    }

    private static void both(
            Map<Class<?>, Plan> plans,
            Class<?> primitive,
            Class<?> boxed,
            Writing writing,
            Function<CborReader, Object> reading) {
        var plan = new SimplePlan(writing, reading);
        plans.put(primitive, plan);
        plans.put(boxed, plan);
    }

    private static void writeTime(long seconds, int nanos, CborWriter out) {
        out.writeArray(2);
        out.writeLong(seconds);
        out.writeLong(nanos);
    }

    private static long readSeconds(CborReader in) {
        in.readArrayOf(2, "[seconds, nanoseconds]");
        return in.readLong(Long.MIN_VALUE, Long.MAX_VALUE);
    }

    private static long readNanos(CborReader in) {
        return in.readLong(0, 999_999_999);
    }

    private static Instant instant(long seconds, long nanos) {
        try {
            return Instant.ofEpochSecond(seconds, nanos);
        } catch (DateTimeException tooFar) {
            throw new UnreadableException(
                    "expected an instant of the years -1000000000 to 1000000000, not second " + seconds);
        }
    }

    private static final class EnumPlan implements Plan {
        private final Map<String, Object> constants = new LinkedHashMap<>();

        EnumPlan(Class<?> type) {
            for (Object constant : type.getEnumConstants()) {
                constants.put(((Enum<?>) constant).name(), constant);
            }
        }

        @Override
        public void write(Object value, CborWriter out) {
            out.writeText(((Enum<?>) value).name());
        }

        @Override
        public Object read(CborReader in) {
            String name = in.readText();
            Object constant = constants.get(name);
            if (constant == null) {
                throw new UnreadableException(
                        "expected one of " + String.join(", ", constants.keySet()) + ", not " + shown(name));
            }
            return constant;
        }
    }

    private static String shown(String text) {
        return "\"" + (text.length() <= 80 ? text : text.substring(0, 77) + "...") + "\"";
    }

    // ---- values with parts

    private record ListPlan(Plan element) implements Plan {
        @Override
        public void write(Object value, CborWriter out) throws Throwable {
            var list = (List<?>) value;
            out.writeArray(list.size());
            if (element instanceof DoublePlan) { // a loop without calls that are not inlined
                for (Object each : list) {
                    out.writeDouble((Double) each);
                }
                return;
            }
            for (Object each : list) {
                element.write(each, out);
            }
        }

        @Override
        public Object read(CborReader in) throws Throwable {
            in.enter();
            int size = in.readArray();
            // as they are read: each of many lists inside of each other may claim all bytes that are left
            var elements = new Object[size < 0 ? FEW_ELEMENTS : Math.min(size, FEW_ELEMENTS)];
            int index = 0;
            try {
                while (size < 0 ? !in.readBreak() : index < size) {
                    if (index == elements.length) {
                        elements = Arrays.copyOf(elements, size < 0 ? 2 * index : Math.min(2 * index, size));
                    }
                    elements[index] = element instanceof DoublePlan ? (Object) in.readDouble() : element.read(in);
                    index++;
                }
            } catch (UnreadableException unreadable) {
                throw unreadable.in("[" + index + "]");
            }
            in.leave();
            return Collections.unmodifiableList(
                    Arrays.asList(index == elements.length ? elements : Arrays.copyOf(elements, index)));
        }
    }

    private record MapPlan(Plan element) implements Plan {
        @Override
        public void write(Object value, CborWriter out) throws Throwable {
            var map = (Map<?, ?>) value;
            out.writeMap(map.size());
            for (var entry : map.entrySet()) {
                out.writeText((String) entry.getKey());
                element.write(entry.getValue(), out);
            }
        }

        @Override
        public Object read(CborReader in) throws Throwable {
            in.enter();
            int size = in.readMap();
            var map = new LinkedHashMap<String, Object>();
            for (int index = 0; size < 0 ? !in.readBreak() : index < size; index++) {
                String key = in.readText();
                try {
                    if (map.put(key, element.read(in)) != null) {
                        throw new UnreadableException("expected each key once");
                    }
                } catch (UnreadableException unreadable) {
                    throw unreadable.in("{" + shown(key) + "}");
                }
            }
            in.leave();
            return Collections.unmodifiableMap(map);
        }
    }

    private record OptionalPlan(Plan value) implements Plan {
        @Override
        public void write(Object optional, CborWriter out) throws Throwable {
            Object content = ((Optional<?>) optional).orElse(null);
            if (content == null) {
                out.writeNull();
            } else {
                if (value.mayBeNull()) {
                    out.writeArray(1);
                }
                value.write(content, out);
            }
        }

        @Override
        public Object read(CborReader in) throws Throwable {
            if (in.readNull()) {
                return Optional.empty();
            }
            in.enter();
            if (value.mayBeNull()) {
                in.readArrayOf(1, "the value of an Optional of an Optional");
            }
            var optional = Optional.of(value.read(in));
            in.leave();
            return optional;
        }

        @Override
        public boolean mayBeNull() {
            return true;
        }
    }

    private static final class SealedPlan implements Plan {
        private record Permitted(Class<?> type, Plan plan) {}

        private final Class<?> type;
        private final Map<String, Permitted> byName = new LinkedHashMap<>();
        private final Map<Class<?>, Permitted> byType = new HashMap<>();

        SealedPlan(Class<?> type) {
            this.type = type;
        }

        void add(Class<?> permitted, Plan plan) {
            var entry = new Permitted(permitted, plan);
            var before = byName.putIfAbsent(permitted.getSimpleName(), entry);
            if (before != null && before.type != permitted) {
                throw new IllegalArgumentException(type.getName() + " permits " + before.type.getName() + " and "
                        + permitted.getName() + ", expected one class for each simple name");
            }
            byType.put(permitted, entry);
        }

        @Override
        public void write(Object value, CborWriter out) throws Throwable {
            Class<?> written = value instanceof Enum<?> constant ? constant.getDeclaringClass() : value.getClass();
            Permitted permitted = byType.get(written);
            if (permitted == null) {
                throw new IllegalArgumentException(written.getName() + " is not permitted by " + type.getName());
            }
            out.writeArray(2);
            out.writeText(written.getSimpleName());
            permitted.plan.write(value, out);
        }

        @Override
        public Object read(CborReader in) throws Throwable {
            in.readArrayOf(2, "[name, value]");
            String name = in.readText();
            Permitted permitted = byName.get(name);
            if (permitted == null) {
                throw new UnreadableException(
                        "expected one of " + String.join(", ", byName.keySet()) + ", not " + shown(name));
            }
            try {
                return permitted.plan.read(in);
            } catch (UnreadableException unreadable) {
                throw unreadable.in("(" + name + ")");
            }
        }
    }

    // ---- records

    /** A component of a record. */
    private static final class Part {
        final String name;
        final Class<?> type;
        final byte[] key;
        final MethodHandle accessor;
        final Plan plan;

        Part(RecordComponent component, Plan plan) {
            this.name = component.getName();
            this.type = component.getType();
            var keyWriter = new CborWriter(32);
            keyWriter.writeText(name);
            this.key = keyWriter.toBytes();
            this.plan = plan;
            MethodType objectToValue =
                    MethodType.methodType(type == double.class ? double.class : Object.class, Object.class);
            this.accessor = unreflected(component.getAccessor()).asType(objectToValue);
        }

        void write(Object record, CborWriter out) throws Throwable {
            out.writeRaw(key);
            if (type == double.class) { // the usual number, which then is not boxed
                out.writeDouble((double) accessor.invokeExact(record));
                return;
            }
            Object value = (Object) accessor.invokeExact(record);
            if (value != null) {
                plan.write(value, out);
            } else if (plan.mayBeNull()) {
                throw new IllegalArgumentException(
                        record.getClass().getName() + "." + name + " is null, expected an Optional");
            } else {
                out.writeNull();
            }
        }

        @Nullable
        Object read(CborReader in) throws Throwable {
            try {
                if (type.isPrimitive() || plan.mayBeNull() || !in.readNull()) {
                    return plan.read(in);
                }
                return null;
            } catch (UnreadableException unreadable) {
                throw unreadable.in("." + name);
            }
        }

        private static MethodHandle unreflected(Method accessor) {
            try {
                accessor.setAccessible(true); // the class of the record need not be public
                return MethodHandles.lookup().unreflect(accessor);
            } catch (IllegalAccessException | InaccessibleObjectException closed) {
                throw closedTo(accessor.getDeclaringClass(), closed);
            }
        }
    }

    private static IllegalArgumentException closedTo(Class<?> type, Throwable cause) {
        return new IllegalArgumentException(
                type.getName() + " cannot be encoded: write \"opens " + type.getPackageName()
                        + ";\" in the module-info of its module",
                cause);
    }

    private static final class RecordPlan implements Plan {
        private final Class<?> type;
        private final MethodHandle constructor;
        Part[] parts = {};

        RecordPlan(Class<?> type) {
            this.type = type;
            this.constructor = constructor(type);
        }

        private static MethodHandle constructor(Class<?> type) {
            Class<?>[] types = Arrays.stream(type.getRecordComponents())
                    .map(RecordComponent::getType)
                    .toArray(Class<?>[]::new);
            try {
                Constructor<?> canonical = type.getDeclaredConstructor(types);
                canonical.setAccessible(true);
                return MethodHandles.lookup()
                        .unreflectConstructor(canonical)
                        .asSpreader(Object[].class, types.length)
                        .asType(MethodType.methodType(Object.class, Object[].class));
            } catch (IllegalAccessException | InaccessibleObjectException closed) {
                throw closedTo(type, closed);
            } catch (NoSuchMethodException impossible) {
                throw new IllegalStateException("a record without its constructor: " + type, impossible);
            }
        }

        @Override
        public void write(Object value, CborWriter out) throws Throwable {
            out.writeMap(parts.length);
            for (Part part : parts) {
                part.write(value, out);
            }
        }

        @Override
        public Object read(CborReader in) throws Throwable {
            in.enter();
            int entries = in.readMap();
            var values = new @Nullable Object[parts.length];
            Arrays.fill(values, MISSING);
            int inOrder = 0;
            for (int entry = 0; entries < 0 ? !in.readBreak() : entry < entries; entry++) {
                int index = inOrder;
                if (index == parts.length || !in.readExactly(parts[index].key)) {
                    index = indexOf(in.readText());
                    if (index < 0) {
                        in.skip();
                        continue;
                    }
                }
                if (values[index] != MISSING) {
                    throw new UnreadableException("expected each component once").in("." + parts[index].name);
                }
                values[index] = parts[index].read(in);
                inOrder = index + 1;
            }
            in.leave();
            addMissing(values);
            return create(values);
        }

        private int indexOf(String name) {
            for (int i = 0; i < parts.length; i++) {
                if (parts[i].name.equals(name)) {
                    return i;
                }
            }
            return -1;
        }

        private void addMissing(@Nullable Object[] values) {
            List<String> missing = List.of();
            for (int i = 0; i < values.length; i++) {
                if (values[i] == MISSING) {
                    values[i] = Optional.empty();
                    if (parts[i].type != Optional.class) {
                        missing = missing.isEmpty() ? new ArrayList<>() : missing;
                        missing.add(parts[i].name);
                    }
                }
            }
            if (!missing.isEmpty()) {
                throw new UnreadableException("expected a " + type.getSimpleName() + ", and "
                        + String.join(", ", missing) + (missing.size() == 1 ? " is missing" : " are missing"));
            }
        }

        private Object create(@Nullable Object[] values) {
            try {
                return (Object) constructor.invokeExact(values);
            } catch (Error machine) {
                throw machine;
            } catch (Throwable rejected) {
                throw new UnreadableException("expected a " + type.getSimpleName() + ", which rejects its values: "
                        + BoundedText.of(rejected));
            }
        }
    }
}
