package io.troupe.actor.internal;

import io.troupe.actor.Promise;
import io.troupe.actor.SuspendingRequest;
import io.troupe.actor.internal.loop.TurnOwner;
import java.lang.reflect.InvocationTargetException;
import java.lang.reflect.Method;
import java.lang.reflect.ParameterizedType;
import java.lang.reflect.Type;
import java.lang.reflect.WildcardType;
import java.util.Arrays;
import java.util.Objects;
import java.util.ServiceLoader;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * How suspend functions of Kotlin are called and run. For generated code; implemented by the module actor-kotlin, which
 * is found through {@link ServiceLoader}. Nothing in this module refers to a class of Kotlin.
 */
public abstract class SuspendingCalls {
    private static final class Found {
        static final @Nullable SuspendingCalls CALLS = ServiceLoader.load(
                        SuspendingCalls.class, SuspendingCalls.class.getClassLoader())
                .findFirst()
                .orElse(null);
    }

    /** A {@code kotlin.coroutines.Continuation} that a proxy does not resume: it takes the promise of the call. */
    public interface PromiseTaker {
        /** The promise that was taken. */
        Promise<?> promise();
    }

    protected SuspendingCalls() {}

    /** True if the method was compiled from a suspend function. */
    public static boolean isSuspending(Method method) {
        Class<?>[] parameters = method.getParameterTypes();
        return parameters.length > 0
                && method.getReturnType() == Object.class
                && parameters[parameters.length - 1].getName().equals("kotlin.coroutines.Continuation");
    }

    /** True if the module that runs suspend functions is there. */
    public static boolean areSupported() {
        return Found.CALLS != null;
    }

    /** The name of a method in the source code, without the mark of value classes that Kotlin's compiler adds. */
    public static String nameOf(Method method) {
        String name = method.getName();
        int mark = name.indexOf('-');
        return mark < 0 ? name : name.substring(0, mark);
    }

    /** The parameter types of a method, without the continuation of a suspend function. */
    public static Class<?>[] parameters(Method method) {
        Class<?>[] all = method.getParameterTypes();
        return isSuspending(method) ? Arrays.copyOf(all, all.length - 1) : all;
    }

    /** The name and parameter types of a method as in source code: {@code greet(String)}. */
    public static String signature(Method method) {
        return nameOf(method)
                + Arrays.stream(parameters(method))
                        .map(Class::getSimpleName)
                        .collect(Collectors.joining(", ", "(", ")"));
    }

    /** The type that a suspend function returns. */
    public static Type result(Method suspending) {
        Type continuation = suspending.getGenericParameterTypes()[suspending.getParameterCount() - 1];
        return continuation instanceof ParameterizedType generic
                        && generic.getActualTypeArguments()[0] instanceof WildcardType result
                        && result.getLowerBounds().length == 1
                ? result.getLowerBounds()[0]
                : Object.class;
    }

    /** True if a suspend function returns nothing but {@code kotlin.Unit}. */
    public static boolean isUnit(Type result) {
        return result.getTypeName().equals("kotlin.Unit");
    }

    /** The only value of {@code kotlin.Unit}. */
    public static Object unit() {
        return known().unitValue();
    }

    /**
     * Calls a suspend function of a proxy.
     *
     * @param arguments without a continuation
     * @return the promise of the call
     */
    public static Promise<?> ask(Method suspending, Object proxy, @Nullable Object[] arguments)
            throws InvocationTargetException, IllegalAccessException {
        PromiseTaker taker = known().newTaker();
        var all = Arrays.copyOf(arguments, arguments.length + 1);
        all[arguments.length] = taker;
        suspending.invoke(proxy, all);
        return taker.promise();
    }

    /** The calls of suspend functions, which {@link #areSupported}. */
    public static SuspendingCalls known() {
        return Objects.requireNonNull(Found.CALLS);
    }

    /**
     * Suspends the caller of a suspend function until the promise of its call is settled.
     *
     * @param continuation the caller's {@code kotlin.coroutines.Continuation}
     * @return what the function returns to its caller
     */
    public static @Nullable Object await(Promise<?> call, Object continuation) {
        return known().suspend(call, continuation);
    }

    /** See {@link #await}; on the caller's thread. */
    protected abstract @Nullable Object suspend(Promise<?> call, Object continuation);

    public abstract PromiseTaker newTaker();

    protected abstract Object unitValue();

    /**
     * Runs the function as a coroutine of the actor, in the turn of the request.
     *
     * @param life the incarnation of the actor
     * @return settled with the outcome of the function
     */
    public abstract Promise<?> start(SuspendingRequest<?> request, Object implementation, TurnOwner life)
            throws Throwable;
}
