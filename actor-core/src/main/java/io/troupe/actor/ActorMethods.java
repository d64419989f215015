package io.troupe.actor;

import io.troupe.actor.promise.Promise;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * Which methods of an actor type are messages, and whether all of them can be.
 *
 * @param messages those a proxy sends, one per name and parameter types
 * @param refused those of a class actor that are not public: calling one on a proxy would run it on the wrong object, so it throws
 */
record ActorMethods(List<Method> messages, List<Method> refused) {
    static ActorMethods of(Class<?> type) {
        checkShape(type);
        List<Method> messages = distinct(type.isInterface() ? abstractMethods(type) : declaredUpToActor(type, true));
        for (Method method : messages) {
            checkMessage(type, method);
        }
        List<Method> refused = type.isInterface()
                ? List.of()
                : distinct(declaredUpToActor(type, false)).stream()
                        .filter(method -> messages.stream().noneMatch(message -> sameSignature(method, message)))
                        .toList();
        return new ActorMethods(messages, refused);
    }

    private static boolean sameSignature(Method first, Method second) {
        return first.getName().equals(second.getName())
                && Arrays.equals(first.getParameterTypes(), second.getParameterTypes());
    }

    /** As a caller writes it: {@code Greeter.greet(String)}. */
    static String show(Method method) {
        return method.getDeclaringClass().getSimpleName() + "." + signature(method);
    }

    static String signature(Method method) {
        return method.getName()
                + Arrays.stream(method.getParameterTypes())
                        .map(Class::getSimpleName)
                        .collect(Collectors.joining(", ", "(", ")"));
    }

    private static void checkShape(Class<?> type) {
        String problem = null;
        if (type.isInterface()) {
            if (type.isAnnotation()) {
                problem = "it is an annotation";
            } else if (type.isSealed()) {
                problem = "it is sealed, so that no proxy can implement it";
            }
        } else if (!Actor.class.isAssignableFrom(type)) {
            problem = "it is a class that does not extend " + Actor.class.getName()
                    + "; use an interface, or extend Actor";
        } else if (Modifier.isFinal(type.getModifiers()) || type.isSealed()) {
            problem = "it is final or sealed, so that its proxy cannot be a subclass";
        } else if (type.isAnonymousClass()) {
            problem = "it is anonymous";
        }
        if (problem != null) {
            throw new ActorTypeException(type.getName() + " cannot be an actor type: " + problem);
        }
    }

    private static void checkMessage(Class<?> type, Method method) {
        Class<?> result = method.getReturnType();
        if (result != void.class && result != Promise.class) {
            String boxed = result.isPrimitive()
                    ? java.lang.invoke.MethodType.methodType(result)
                            .wrap()
                            .returnType()
                            .getSimpleName()
                    : result.getSimpleName();
            throw new ActorTypeException(
                    show(method) + " of actor type " + type.getName() + " returns " + result.getSimpleName()
                            + ", expected void (a one-way message) or Promise (a request): make it Promise<" + boxed
                            + "> and answer Promise.of(..)"
                            + (type.isInterface()
                                    ? ", or make it a default or static method"
                                    : ", or make it less visible than public"));
        }
        if (Modifier.isFinal(method.getModifiers())) {
            throw new ActorTypeException(
                    show(method) + " of actor type " + type.getName()
                            + " is final, so that a proxy cannot send it as a message: remove final, or make it less visible than public");
        }
    }

    private static List<Method> abstractMethods(Class<?> type) {
        return Arrays.stream(type.getMethods())
                .filter(method -> Modifier.isAbstract(method.getModifiers()) && !isObjectMethod(method))
                .toList();
    }

    /** Public (or all other overridable) instance methods of the class and its superclasses below {@link Actor}. */
    private static List<Method> declaredUpToActor(Class<?> type, boolean isPublic) {
        var methods = new ArrayList<Method>();
        for (Class<?> each = type; each != Actor.class; each = java.util.Objects.requireNonNull(each.getSuperclass())) {
            for (Method method : each.getDeclaredMethods()) {
                int modifiers = method.getModifiers();
                if (Modifier.isStatic(modifiers)
                        || Modifier.isPrivate(modifiers)
                        || method.isSynthetic()
                        || isObjectMethod(method)
                        || isLifecycle(method)
                        || Modifier.isPublic(modifiers) != isPublic) {
                    continue;
                }
                boolean packagePrivate = !Modifier.isPublic(modifiers) && !Modifier.isProtected(modifiers);
                if (!isPublic
                        && (Modifier.isFinal(modifiers) || packagePrivate && each.getPackage() != type.getPackage())) {
                    continue; // cannot be overridden
                }
                methods.add(method);
            }
        }
        return methods;
    }

    private static boolean isLifecycle(Method method) {
        return method.getParameterCount() == 0
                && (method.getName().equals("started") || method.getName().equals("stopped"));
    }

    private static boolean isObjectMethod(Method method) {
        return Arrays.stream(Object.class.getDeclaredMethods())
                .anyMatch(each -> each.getName().equals(method.getName())
                        && Arrays.equals(each.getParameterTypes(), method.getParameterTypes()));
    }

    /** The first of each name and parameter types (the most derived one), in an order that does not depend on reflection's. */
    private static List<Method> distinct(List<Method> methods) {
        Map<String, @Nullable Method> bySignature = new LinkedHashMap<>();
        for (Method method : methods) {
            String key = method.getName() + Arrays.toString(method.getParameterTypes());
            bySignature.merge(
                    key,
                    method,
                    (first, second) -> first.getReturnType() != second.getReturnType()
                                    && first.getReturnType().isAssignableFrom(second.getReturnType())
                            ? second
                            : first);
        }
        return bySignature.values().stream()
                .sorted(Comparator.<Method, String>comparing(Method::getName)
                        .thenComparing(method -> Arrays.toString(method.getParameterTypes())))
                .toList();
    }
}
