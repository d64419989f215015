package io.troupe.actor.internal;

import io.troupe.actor.internal.loop.Owner;
import io.troupe.actor.promise.Promise;
import java.lang.reflect.Method;
import java.util.Objects;
import java.util.ServiceLoader;
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

    static SuspendingCalls known() {
        return Objects.requireNonNull(Found.CALLS);
    }

    /**
     * Suspends the caller of a suspend function until the request, which was sent, is settled.
     *
     * @param continuation the caller's {@code kotlin.coroutines.Continuation}
     * @return what the function returns to its caller
     */
    public static @Nullable Object await(SuspendingRequest<?> request, Object continuation) {
        return known().suspend(request, continuation);
    }

    /** See {@link #await}; on the caller's thread. */
    protected abstract @Nullable Object suspend(SuspendingRequest<?> request, Object continuation);

    /**
     * Runs the function as a coroutine of the actor, in the turn of the request.
     *
     * @param life the incarnation of the actor
     * @return settled with the outcome of the function
     */
    protected abstract Promise<?> start(SuspendingRequest<?> request, Object implementation, Owner life)
            throws Throwable;
}
