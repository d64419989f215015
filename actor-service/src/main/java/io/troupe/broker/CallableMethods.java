package io.troupe.broker;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.actor.internal.SuspendingCalls;
import io.troupe.actor.internal.TypeArguments;
import io.troupe.bus.internal.CborItem;
import io.troupe.bus.internal.CborReader;
import io.troupe.bus.internal.CborWriter;
import io.troupe.bus.internal.Portable;
import io.troupe.bus.internal.RecordCodec;
import io.troupe.bus.internal.RecordCopier;
import io.troupe.bus.internal.UnreadableException;
import io.troupe.common.text.Suggestions;
import java.lang.reflect.InaccessibleObjectException;
import java.lang.reflect.InvocationTargetException;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.lang.reflect.ParameterizedType;
import java.lang.reflect.Type;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.ToLongFunction;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * The methods of an actor interface as they are called from other processes: their names there, and their arguments and
 * results as bytes. They are the messages of the type ({@link ActorSpace#messages}).
 *
 * <p><b>Threads.</b> Any thread.
 */
final class CallableMethods {
    private static final int EXPECTED_SIZE = 128;

    private final Map<String, CallableMethod> byName = new LinkedHashMap<>();

    /** Values of any type as bytes, shared by the interfaces of one process. */
    static final class Values {
        private final RecordCodec codec = new RecordCodec();
        private final RecordCopier copier = new RecordCopier();

        /** @throws IllegalArgumentException if the value cannot leave the process */
        CborItem encode(Type type, @Nullable Object value) {
            var out = new CborWriter(EXPECTED_SIZE);
            write(type, value, out);
            return CborItem.of(out);
        }

        private void write(Type type, @Nullable Object value, CborWriter out) {
            if (value != null) {
                codec.write(type, copier.copyOfPart(value), out);
            } else if (isNullable(type)) {
                out.writeNull();
            } else {
                throw new IllegalArgumentException("a value of " + type.getTypeName() + " is null");
            }
        }

        /** @throws UnreadableException if the item is no value of the type */
        @Nullable
        Object decode(Type type, CborItem item) {
            return read(type, item.reader());
        }

        private @Nullable Object read(Type type, CborReader in) {
            if (type == Void.class) {
                in.skip();
                return null;
            }
            return isNullable(type) && in.readNull() ? null : codec.read(type, in);
        }

        private static boolean isNullable(Type type) {
            return type instanceof Class<?> plain
                    ? !plain.isPrimitive()
                    : !(type instanceof ParameterizedType generic && generic.getRawType() == Optional.class);
        }

        private void check(String use, Type type) {
            if (type != Void.class) {
                Portable.checkValue(use, type);
                codec.prepare(type);
            }
        }
    }

    private CallableMethods() {}

    /**
     * The methods of an interface.
     *
     * @throws IllegalArgumentException if one of them cannot be called from another process; the message names it, the
     *     parameter and the reason
     */
    static CallableMethods of(Class<?> type, Values values) {
        if (!type.isInterface()) {
            throw new IllegalArgumentException(
                    type.getName() + " cannot be called from other hosts: it is a class, expected an interface");
        }
        var methods = new CallableMethods();
        var arguments = new TypeArguments(type);
        for (Method method : ActorSpace.messages(type)) {
            methods.add(new CallableMethod(type, method, arguments, values));
        }
        return methods;
    }

    private void add(CallableMethod method) {
        CallableMethod before = byName.putIfAbsent(method.name, method);
        if (before != null && !Arrays.equals(before.method.getParameterTypes(), method.method.getParameterTypes())) {
            throw method.rejection("there is " + shown(before.method) + " as well as " + shown(method.method)
                    + ", expected methods that differ in the simple names of their types");
        }
    }

    private static String shown(Method method) {
        return Arrays.stream(method.getParameterTypes())
                .map(Class::getName)
                .collect(Collectors.joining(", ", method.getName() + "(", ")"));
    }

    List<String> names() {
        return List.copyOf(byName.keySet());
    }

    /** Without default methods, which the interface of a provider need not have. */
    List<String> abstractNames() {
        return byName.values().stream()
                .filter(each -> Modifier.isAbstract(each.method.getModifiers()))
                .map(each -> each.name)
                .toList();
    }

    @Nullable
    CallableMethod method(String name) {
        return byName.get(name);
    }

    /** For a message about a name that is not among them. */
    String hint(String name) {
        return Suggestions.hint(name, byName.keySet());
    }

    /** One method. */
    static final class CallableMethod {
        final Method method;
        final String name;
        private final Class<?> owner;
        private final Values values;
        private final Type[] parameters;
        private final @Nullable Type result; // null: a one-way method
        private final boolean isUnit; // the result is kotlin.Unit, which crosses as null

        CallableMethod(Class<?> owner, Method method, TypeArguments typeArguments, Values values) {
            this.owner = owner;
            this.method = method;
            this.name = SuspendingCalls.signature(method);
            this.values = values;
            int count = SuspendingCalls.parameters(method).length;
            this.parameters = Arrays.stream(method.getGenericParameterTypes(), 0, count)
                    .map(typeArguments::resolve)
                    .toArray(Type[]::new);
            for (int i = 0; i < parameters.length; i++) {
                String use = describe("parameter " + (i + 1));
                if (method.getParameterTypes()[i] == Callback.class) {
                    values.check(use, argumentOf(parameters[i], "a Callback of values"));
                } else if (parameters[i] == Void.class) {
                    throw rejection("parameter " + (i + 1) + " is a Void, expected a value");
                } else {
                    values.check(use, parameters[i]);
                }
            }
            Type asWritten = returned();
            Type returned = asWritten == null ? null : typeArguments.resolve(asWritten);
            isUnit = returned != null && SuspendingCalls.areSupported() && SuspendingCalls.isUnit(returned);
            result = isUnit ? Void.class : returned;
            if (result != null) {
                values.check(describe("result"), result);
            }
            makeAccessible();
        }

        /** The type of the result as it is written; null for a one-way method. */
        private @Nullable Type returned() {
            Class<?> plain = method.getReturnType();
            if (plain == Promise.class) {
                return argumentOf(method.getGenericReturnType(), "a Promise of a value");
            }
            if (isSuspending()) {
                return SuspendingCalls.result(method);
            }
            if (plain == void.class) {
                return null;
            }
            throw new AssertionError("a message returns void or a Promise, or suspends: " + method);
        }

        /** True for a suspend function of Kotlin. */
        boolean isSuspending() {
            return SuspendingCalls.isSuspending(method);
        }

        private void makeAccessible() {
            try {
                method.setAccessible(true); // the interface need not be public
            } catch (InaccessibleObjectException closed) {
                throw rejection("write \"opens " + owner.getPackageName() + ";\" in the module-info of its module");
            }
        }

        private Type argumentOf(Type type, String expected) {
            if (type instanceof ParameterizedType generic) {
                return generic.getActualTypeArguments()[0];
            }
            throw rejection("it has a " + type.getTypeName() + ", expected " + expected);
        }

        IllegalArgumentException rejection(String why) {
            return new IllegalArgumentException(describe(why));
        }

        private String describe(String what) {
            return owner.getSimpleName() + "." + name + " cannot be called from other hosts: " + what;
        }

        /**
         * Encodes the arguments of a call.
         *
         * @param streams gives a callback the number of its stream; called with the index of the parameter
         * @throws IllegalArgumentException if a value cannot leave the process
         */
        CborItem encode(@Nullable Object[] arguments, ToLongFunction<Integer> streams) {
            var out = new CborWriter(EXPECTED_SIZE);
            out.writeArray(parameters.length);
            for (int i = 0; i < parameters.length; i++) {
                if (arguments[i] instanceof Callback<?>) {
                    var number = new CallMessages.StreamNumber(streams.applyAsLong(i));
                    values.write(CallMessages.StreamNumber.class, number, out);
                } else {
                    encode(i, arguments[i], out);
                }
            }
            return CborItem.of(out);
        }

        private void encode(int parameter, @Nullable Object argument, CborWriter out) {
            try {
                if (isStream(parameter)) {
                    out.writeNull(); // null in place of a callback
                } else {
                    values.write(parameters[parameter], argument, out);
                }
            } catch (RuntimeException unfit) { // also the wrong elements in a list
                throw new IllegalArgumentException(
                        "argument " + (parameter + 1) + " cannot be sent: " + unfit.getMessage(), unfit);
            }
        }

        private boolean isStream(int parameter) {
            return method.getParameterTypes()[parameter] == Callback.class;
        }

        /** The type of the items of a callback parameter. */
        Type streamed(int parameter) {
            return argumentOf(parameters[parameter], "a Callback of values");
        }

        boolean isOneWay() {
            return result == null;
        }

        /** Makes the callback for a stream of the caller. */
        interface StreamOpener {
            Callback<@Nullable Object> open(long stream, Type items);
        }

        /** @throws UnreadableException if they are no arguments of this method */
        @Nullable
        Object[] decode(CborItem arguments, StreamOpener streams) {
            CborReader in = arguments.reader();
            int size = in.readArray();
            if (size >= 0 && size != parameters.length) {
                throw new UnreadableException("expected " + parameters.length + " arguments, not " + size).in(name);
            }
            var decoded = new @Nullable Object[parameters.length];
            for (int i = 0; i < decoded.length; i++) {
                try {
                    decoded[i] = isStream(i) ? stream(i, in, streams) : values.read(parameters[i], in);
                } catch (UnreadableException unreadable) {
                    throw unreadable.in(name + " argument " + (i + 1) + " ");
                }
            }
            if (size < 0 && !in.readBreak()) {
                throw new UnreadableException("expected " + parameters.length + " arguments, not more").in(name);
            }
            return decoded;
        }

        private @Nullable Object stream(int parameter, CborReader in, StreamOpener streams) {
            var number = (CallMessages.@Nullable StreamNumber) values.read(CallMessages.StreamNumber.class, in);
            return number == null ? null : streams.open(number.stream(), streamed(parameter));
        }

        CborItem encodeResult(@Nullable Object value) {
            return values.encode(result == null ? Void.class : result, isUnit ? null : value);
        }

        @Nullable
        Object decodeResult(CborItem item) {
            return isUnit ? SuspendingCalls.unit() : values.decode(result == null ? Void.class : result, item);
        }

        /** Calls the method of an actor; returns the promise of a request, or null. */
        static @Nullable Object invoke(Method method, Object proxy, @Nullable Object[] arguments)
                throws InvocationTargetException, IllegalAccessException {
            return SuspendingCalls.isSuspending(method)
                    ? SuspendingCalls.ask(method, proxy, arguments)
                    : method.invoke(proxy, arguments);
        }

        @Override
        public String toString() {
            return owner.getSimpleName() + "." + name;
        }
    }
}
