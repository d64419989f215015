package io.troupe.actor;

import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

/**
 * The methods of a class actor that are not messages. None may run on a proxy, whose fields are unset: the proxy
 * overrides them to throw, so they must be overridable.
 */
final class NonMessageMethods {
    private NonMessageMethods() {}

    /** The overridable methods that are not public, each once. */
    static List<Method> of(Class<?> type) {
        var derived = new ArrayList<Method>(); // methods of the subclasses of the current class
        var refused = new ArrayList<Method>();
        for (Class<?> each = type; each != Actor.class; each = java.util.Objects.requireNonNull(each.getSuperclass())) {
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
