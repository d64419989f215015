package io.troupe.actor;

import io.troupe.actor.internal.SuspendingCalls;
import io.troupe.actor.internal.TypeArguments;
import java.lang.invoke.MethodType;
import java.lang.reflect.GenericArrayType;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.lang.reflect.Parameter;
import java.lang.reflect.ParameterizedType;
import java.lang.reflect.Type;
import java.lang.reflect.WildcardType;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Future;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * The methods of an actor type that are messages.
 *
 * <p>For an interface these are the abstract methods, and the default methods whose return type a message may have,
 * since the implementation may override them. Other default methods run on the caller's thread. For a class actor these
 * are all public methods, including inherited default methods: no other code may run on its proxy, whose fields are
 * unset.
 *
 * @param messages the methods that a proxy sends, one per name and parameter types
 * @param bridges further methods that a proxy must implement, because a supertype calls a message by another descriptor
 * @param refused the methods of a class actor that are not public: calling one on a proxy throws
 */
record ActorMethods(List<Method> messages, List<Bridge> bridges, List<Method> refused) {
    /** A call of {@code from} is redirected to {@code to}. */
    record Bridge(Method from, Method to) {}

    /**
     * The method that callers link to, and the one in the source code; they differ if the compiler generated a bridge.
     */
    private record Found(Method called, Method written) {}

    static ActorMethods of(Class<?> type) {
        var rules = new MethodRules(type);
        var messages = new ArrayList<Method>();
        var bridges = new ArrayList<Bridge>();
        for (List<Found> same : groups(type, rules.arguments())) {
            Method chosen = choose(same, rules.arguments());
            boolean isMessage = !type.isInterface() || isAbstract(chosen) || MethodRules.canBeMessage(chosen);
            if (isMessage) {
                rules.checkMessage(chosen);
                same.stream()
                        .map(Found::written)
                        .filter(written -> descriptor(written).equals(descriptor(chosen)))
                        .forEach(rules::checkArguments);
                messages.add(chosen);
            }
            same.stream()
                    .filter(found -> isAbstract(found.called())
                            || isMessage
                                    && type.isInterface()
                                    && !found.called().isBridge())
                    .filter(found -> !descriptor(found.called()).equals(descriptor(chosen)))
                    .forEach(found -> bridges.add(new Bridge(found.called(), chosen)));
        }
        bridges.forEach(bridge -> rules.checkBridge(bridge.from(), bridge.to()));
        return new ActorMethods(
                messages, distinct(bridges), type.isInterface() ? List.of() : NonMessageMethods.of(type));
    }

    /** The public methods that could be messages, grouped by those that are one method to the compiler. */
    private static Iterable<List<Found>> groups(Class<?> type, TypeArguments arguments) {
        return Arrays.stream(type.getMethods())
                .filter(method -> !Modifier.isStatic(method.getModifiers())
                        && method.getDeclaringClass() != Object.class
                        && !isLocal(method)
                        && (type.isInterface() || !isLifecycle(method)))
                .sorted(Comparator.comparing(Method::getName) // independent of the order of reflection
                        .thenComparing(ActorMethods::descriptor)
                        .thenComparing(method -> method.getDeclaringClass().getName()))
                .map(method -> new Found(method, method.isBridge() ? written(method) : method))
                .collect(Collectors.groupingBy(
                        found -> List.of(found.written().getName(), arguments.parameters(found.written())),
                        LinkedHashMap::new,
                        Collectors.toList()))
                .values();
    }

    /** The most specific method: with the type's own parameter types, and the narrowest result. */
    private static Method choose(List<Found> same, TypeArguments arguments) {
        Method chosen = same.getFirst().written();
        for (Found found : same) {
            Method next = found.written();
            boolean exact = isExact(next, arguments);
            Class<?> before = chosen.getReturnType();
            boolean narrower = next.getReturnType() != before && before.isAssignableFrom(next.getReturnType());
            if (exact == isExact(chosen, arguments) ? narrower : exact) {
                chosen = next;
            }
        }
        return chosen;
    }

    private static boolean isAbstract(Method method) {
        return Modifier.isAbstract(method.getModifiers());
    }

    private static boolean isExact(Method method, TypeArguments arguments) {
        return arguments.parameters(method).equals(List.of(method.getParameterTypes()));
    }

    /** The method of a supertype that a bridge overrides. */
    private static Method written(Method bridge) {
        return supertypes(bridge.getDeclaringClass())
                .flatMap(type -> Arrays.stream(type.getDeclaredMethods()))
                .filter(method -> !method.isBridge()
                        && method.getName().equals(bridge.getName())
                        && descriptor(method).equals(descriptor(bridge)))
                .findFirst()
                .orElse(bridge);
    }

    private static Stream<Class<?>> supertypes(Class<?> type) {
        Class<?> parent = type.getSuperclass();
        return Stream.concat(
                parent == null ? Stream.empty() : Stream.concat(Stream.of(parent), supertypes(parent)),
                Arrays.stream(type.getInterfaces()).flatMap(each -> Stream.concat(Stream.of(each), supertypes(each))));
    }

    private static List<Bridge> distinct(List<Bridge> bridges) {
        Map<String, Bridge> byDescriptor = new LinkedHashMap<>();
        for (Bridge bridge : bridges) {
            byDescriptor.putIfAbsent(bridge.from().getName() + descriptor(bridge.from()), bridge);
        }
        return List.copyOf(byDescriptor.values());
    }

    static String descriptor(Method method) {
        return org.objectweb.asm.Type.getMethodDescriptor(method);
    }

    /**
     * The name of a message of an interface that would be a hook too in an implementation that extends {@link Actor}.
     */
    static Optional<String> hookMessage(Class<?> type) {
        return Arrays.stream(type.getMethods())
                .filter(method ->
                        type.isInterface() && !Modifier.isStatic(method.getModifiers()) && isLifecycle(method))
                .map(Method::getName)
                .min(Comparator.naturalOrder());
    }

    /** Called by the actor's own cell only. */
    static boolean isLifecycle(Method method) {
        return method.getParameterCount() == 0
                && (method.getName().equals("started") || method.getName().equals("stopped"));
    }

    /** The methods that every proxy implements locally. */
    static boolean isLocal(Method method) {
        return switch (method.getName()) {
            case "hashCode", "toString" -> method.getParameterCount() == 0;
            case "equals" -> Arrays.equals(method.getParameterTypes(), new Class<?>[] {Object.class});
            default -> false;
        };
    }

    /** The method as in source code: {@code Greeter.greet(String)}. */
    static String show(Method method) {
        return method.getDeclaringClass().getSimpleName() + "." + SuspendingCalls.signature(method);
    }

    /**
     * The methods of a class actor that are not messages. None may run on a proxy, whose fields are unset: the proxy
     * overrides them to throw, so they must be overridable.
     */
    private static final class NonMessageMethods {
        private NonMessageMethods() {}

        /** The overridable methods that are not public, each once. */
        static List<Method> of(Class<?> type) {
            var derived = new ArrayList<Method>(); // methods of the subclasses of the current class
            var refused = new ArrayList<Method>();
            for (Class<?> each = type;
                    each != Actor.class;
                    each = java.util.Objects.requireNonNull(each.getSuperclass())) {
                List<Method> own = instanceMethods(each);
                for (Method method : own) {
                    check(type, method);
                    if (Modifier.isPublic(method.getModifiers())
                            || ActorMethods.isLifecycle(method)
                            || derived.stream().anyMatch(below -> overrides(below, method))) {
                        continue;
                    }
                    if (isPackagePrivate(method) && !inOnePackage(each, type)) {
                        throw MethodRules.wrong(
                                type,
                                method,
                                "is package-private in another package, so that its proxy would run it: make it protected or private");
                    }
                    if (!method.isBridge()) {
                        refused.add(method);
                    }
                }
                derived.addAll(own);
            }
            refused.sort(Comparator.comparing(Method::getName).thenComparing(ActorMethods::descriptor));
            return refused;
        }

        private static List<Method> instanceMethods(Class<?> type) {
            var methods = new ArrayList<Method>();
            for (Method method : type.getDeclaredMethods()) {
                if (!Modifier.isStatic(method.getModifiers()) && !Modifier.isPrivate(method.getModifiers())) {
                    methods.add(method);
                }
            }
            methods.sort(Comparator.comparing(Method::getName).thenComparing(ActorMethods::descriptor));
            return methods;
        }

        private static void check(Class<?> type, Method method) {
            boolean isPublic = Modifier.isPublic(method.getModifiers());
            boolean isMessage = isPublic && !ActorMethods.isLocal(method) && !ActorMethods.isLifecycle(method);
            if (Modifier.isFinal(method.getModifiers()) && !isMessage) {
                throw MethodRules.wrong(
                        type,
                        method,
                        "is final, so that its proxy would run it on itself: remove final (in Kotlin, make it open)"
                                + (isPublic ? "" : ", or make it private"));
            }
            if (isPublic && ActorMethods.isLifecycle(method)) {
                throw MethodRules.wrong(
                        type,
                        method,
                        "is public, which would make the hook of Actor a message too: make it protected, or give the message another name");
            }
            if (method.getName().equals("finalize") && method.getParameterCount() == 0) {
                throw MethodRules.wrong(
                        type, method, "would be called on the proxy by the garbage collector: use stopped()");
            }
        }

        private static boolean overrides(Method below, Method above) {
            return below.getName().equals(above.getName())
                    && ActorMethods.descriptor(below).equals(ActorMethods.descriptor(above))
                    && (!isPackagePrivate(above) || inOnePackage(below.getDeclaringClass(), above.getDeclaringClass()));
        }

        private static boolean isPackagePrivate(Method method) {
            return (method.getModifiers() & (Modifier.PUBLIC | Modifier.PROTECTED | Modifier.PRIVATE)) == 0;
        }

        /** By the definition of the virtual machine. */
        private static boolean inOnePackage(Class<?> one, Class<?> other) {
            return one.getClassLoader() == other.getClassLoader()
                    && one.getPackageName().equals(other.getPackageName());
        }
    }

    /** Types as in source code, by their simple names: {@code List<String>}. */
    private static final class TypeText {
        private TypeText() {}

        static String of(Type type) {
            return switch (type) {
                case Class<?> named -> named.getSimpleName();
                case ParameterizedType generic ->
                    of(generic.getRawType())
                            + Arrays.stream(generic.getActualTypeArguments())
                                    .map(TypeText::of)
                                    .collect(Collectors.joining(", ", "<", ">"));
                case GenericArrayType array -> of(array.getGenericComponentType()) + "[]";
                case WildcardType wild
                when wild.getLowerBounds().length > 0 -> "? super " + of(wild.getLowerBounds()[0]);
                case WildcardType wild ->
                    wild.getUpperBounds()[0] == Object.class ? "?" : "? extends " + of(wild.getUpperBounds()[0]);
                default -> type.getTypeName();
            };
        }
    }

    /** The requirements on a method that is a message; the error for a violation names the alternative. */
    private static final class MethodRules {
        /** The virtual machine's limit of 255 argument slots, less the message under construction and its cell. */
        private static final int SLOTS = 253;

        private final Class<?> type;
        private final TypeArguments arguments;

        MethodRules(Class<?> type) {
            this.type = type;
            this.arguments = new TypeArguments(type);
        }

        TypeArguments arguments() {
            return arguments;
        }

        static boolean canBeMessage(Method method) {
            return method.getReturnType() == void.class
                    || method.getReturnType() == Promise.class
                    || SuspendingCalls.isSuspending(method);
        }

        void checkMessage(Method method) {
            if (!canBeMessage(method)) {
                throw wrong(
                        method,
                        "returns " + TypeText.of(method.getGenericReturnType())
                                + ", expected void (a one-way message) or Promise (a request): make it "
                                + asPromise(method) + wayOut(method));
            }
            if (SuspendingCalls.isSuspending(method)) {
                checkSuspending(method);
            }
            if (Modifier.isFinal(method.getModifiers())) {
                throw wrong(
                        method,
                        "is final, so that a proxy cannot send it as a message: remove final (in Kotlin, make it open), or make it private");
            }
            if (method.getName().equals("finalize") && method.getParameterCount() == 0) {
                throw wrong(
                        method,
                        "would be called on the proxy by the garbage collector: give it another name, or use stopped()");
            }
            int slots = Arrays.stream(method.getParameterTypes())
                    .mapToInt(each -> each == long.class || each == double.class ? 2 : 1)
                    .sum();
            if (slots > SLOTS) {
                throw wrong(
                        method,
                        "takes " + slots + " argument slots (a long or double takes two), expected at most " + SLOTS
                                + ": pass an array or a record");
            }
        }

        /** The return type that the author of a method meant, and how to return its value. */
        private static String asPromise(Method method) {
            Class<?> result = method.getReturnType();
            boolean isStage = CompletionStage.class.isAssignableFrom(result);
            if (!isStage && !Future.class.isAssignableFrom(result) && !Promise.class.isAssignableFrom(result)) {
                Class<?> boxed = MethodType.methodType(result).wrap().returnType();
                String value = TypeText.of(result.isPrimitive() ? boxed : method.getGenericReturnType());
                return "Promise<" + value + ">, and return Promise.of(..)";
            }
            String value = method.getGenericReturnType() instanceof ParameterizedType generic
                            && generic.getActualTypeArguments().length == 1
                    ? TypeText.of(generic.getActualTypeArguments()[0])
                    : "Object";
            String how = isStage
                    ? ", and return Promise.from(future)"
                    : Promise.class.isAssignableFrom(result)
                            ? ", which " + result.getSimpleName() + " is"
                            : ", and return space().offload(future::get), since get() blocks";
            return "Promise<" + value + ">" + how;
        }

        private void checkSuspending(Method method) {
            if (!SuspendingCalls.areSupported()) {
                throw wrong(
                        method,
                        "is a suspend function: add troupe-actor-kotlin, which runs these, or return a Promise");
            }
            Type result = SuspendingCalls.result(method);
            if (hasTwoForms(arguments.erase(result))) {
                throw wrong(
                        method,
                        "is a suspend function that returns " + result.getTypeName()
                                + ", a value class around a reference, which Kotlin returns boxed or unboxed: return what it holds, or a Promise of it");
            }
        }

        /**
         * True for a value class of Kotlin that a suspend function returns unboxed if it has not suspended, else boxed.
         */
        private static boolean hasTwoForms(Class<?> result) {
            return Arrays.stream(result.getAnnotations())
                            .anyMatch(each -> each.annotationType().getName().equals("kotlin.jvm.JvmInline"))
                    && Arrays.stream(result.getDeclaredMethods())
                            .anyMatch(each -> each.getName().equals("unbox-impl")
                                    && !each.getReturnType().isPrimitive());
        }

        private String wayOut(Method method) {
            if (type.isInterface()) {
                return ", or make it a default or static method";
            }
            return method.getDeclaringClass().isInterface()
                    ? "; a default method would run on the proxy, whose fields are unset: make it static, or spawn the actor by an interface"
                    : ", or make it less visible than public";
        }

        /** A callback hidden inside another type would run the caller's code on the actor's thread, or vice versa. */
        void checkArguments(Method method) {
            Type[] types = method.getGenericParameterTypes();
            for (int index = 0; index < SuspendingCalls.parameters(method).length; index++) {
                if (hidesCallback(types[index])) {
                    Parameter parameter = method.getParameters()[index];
                    throw wrong(
                            method,
                            "has parameter " + (index + 1) + " (" + parameter.getName() + ") of type "
                                    + types[index].getTypeName()
                                    + ", which holds a callback that would run on the actor's side: declare the parameter as Callback<T>");
                }
            }
            Type result = SuspendingCalls.isSuspending(method)
                    ? SuspendingCalls.result(method)
                    : method.getGenericReturnType();
            if (arguments.mentions(result, Callback.class)) {
                throw wrong(
                        method,
                        "answers " + result.getTypeName()
                                + ", a callback that would run on the caller's side: let a method take what the callback would be sent");
            }
        }

        private boolean hidesCallback(Type written) {
            return written instanceof ParameterizedType generic && generic.getRawType() == Callback.class
                    ? Arrays.stream(generic.getActualTypeArguments())
                            .anyMatch(argument -> arguments.mentions(argument, Callback.class))
                    : written != Callback.class && arguments.mentions(written, Callback.class);
        }

        void checkBridge(Method from, Method to) {
            if (!from.getReturnType().isAssignableFrom(to.getReturnType())) {
                throw wrong(
                        from,
                        "returns " + from.getReturnType().getSimpleName() + ", but " + ActorMethods.show(to)
                                + " returns " + to.getReturnType().getSimpleName() + ": a method of both cannot exist");
            }
        }

        private ActorTypeException wrong(Method method, String problem) {
            return wrong(type, method, problem);
        }

        static ActorTypeException wrong(Class<?> type, Method method, String problem) {
            return new ActorTypeException(
                    ActorMethods.show(method) + " of actor type " + type.getName() + " " + problem);
        }
    }
}
