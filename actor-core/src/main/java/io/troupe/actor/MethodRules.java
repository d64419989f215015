package io.troupe.actor;

import io.troupe.actor.promise.Promise;
import java.lang.invoke.MethodType;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.lang.reflect.Parameter;
import java.lang.reflect.ParameterizedType;
import java.lang.reflect.Type;
import java.util.Arrays;

/** The requirements on a method that is a message; the error for a violation names the alternative. */
final class MethodRules {
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
        return method.getReturnType() == void.class || method.getReturnType() == Promise.class;
    }

    void checkMessage(Method method) {
        Class<?> result = method.getReturnType();
        if (!canBeMessage(method)) {
            throw wrong(
                    method,
                    "returns " + result.getSimpleName()
                            + ", expected void (a one-way message) or Promise (a request): make it Promise<"
                            + MethodType.methodType(result).wrap().returnType().getSimpleName()
                            + "> and answer Promise.of(..)" + wayOut(method));
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
        for (int index = 0; index < types.length; index++) {
            if (hidesCallback(types[index])) {
                Parameter parameter = method.getParameters()[index];
                throw wrong(
                        method,
                        "has parameter " + (index + 1) + " (" + parameter.getName() + ") of type "
                                + types[index].getTypeName()
                                + ", which holds a callback that would run on the actor's side: declare the parameter as Callback<T>");
            }
        }
        if (arguments.mentions(method.getGenericReturnType(), Callback.class)) {
            throw wrong(
                    method,
                    "answers " + method.getGenericReturnType().getTypeName()
                            + ", a callback that would run on the asker's side: let a method take what the callback would be sent");
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
                    "returns " + from.getReturnType().getSimpleName() + ", but " + ActorMethods.show(to) + " returns "
                            + to.getReturnType().getSimpleName() + ": a method of both cannot exist");
        }
    }

    private ActorTypeException wrong(Method method, String problem) {
        return wrong(type, method, problem);
    }

    static ActorTypeException wrong(Class<?> type, Method method, String problem) {
        return new ActorTypeException(ActorMethods.show(method) + " of actor type " + type.getName() + " " + problem);
    }
}
