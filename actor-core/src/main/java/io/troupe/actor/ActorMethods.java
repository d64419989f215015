package io.troupe.actor;

import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
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
        return method.getDeclaringClass().getSimpleName() + "." + signature(method);
    }

    static String signature(Method method) {
        return method.getName()
                + Arrays.stream(method.getParameterTypes())
                        .map(Class::getSimpleName)
                        .collect(Collectors.joining(", ", "(", ")"));
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
}
