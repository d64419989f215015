package io.troupe.broker;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.internal.SuspendingCalls;
import io.troupe.actor.promise.Promise;
import java.lang.invoke.MethodHandle;
import java.lang.invoke.MethodHandles;
import java.lang.reflect.InaccessibleObjectException;
import java.lang.reflect.InvocationHandler;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.lang.reflect.Proxy;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/** The proxy for a provider: sends every call to the connection's actor. Runs on the caller's thread. */
final class ServiceProxy implements InvocationHandler {
    private final Class<?> type;
    private final Need need;
    private final ActorSpace space;
    private final CallDispatcher dispatcher;

    private ServiceProxy(Class<?> type, Need need, ActorSpace space, CallDispatcher dispatcher) {
        this.type = type;
        this.space = space;
        this.need = need;
        this.dispatcher = dispatcher;
    }

    static <A> A of(Class<A> type, Need need, ActorSpace space, CallDispatcher dispatcher) {
        return type.cast(Proxy.newProxyInstance(
                type.getClassLoader(), new Class<?>[] {type}, new ServiceProxy(type, need, space, dispatcher)));
    }

    static void check(Class<?> type) {
        if (!type.isInterface()) {
            throw new IllegalArgumentException(
                    "a connection is made by an interface, and " + type.getName() + " is a class: publish it by one");
        }
        for (Method method : type.getMethods()) {
            Class<?> result = method.getReturnType();
            boolean isSuspending = SuspendingCalls.isSuspending(method) && SuspendingCalls.areSupported();
            if (Modifier.isAbstract(method.getModifiers())
                    && result != void.class
                    && result != Promise.class
                    && !isSuspending) {
                throw new IllegalArgumentException(type.getName() + "." + method.getName() + " returns "
                        + result.getSimpleName() + ", expected void (a one-way message) or Promise (a request)");
            }
            try {
                method.setAccessible(true);
            } catch (InaccessibleObjectException closed) {
                throw new IllegalArgumentException(
                        type.getName() + " cannot be called from here: write \"opens " + type.getPackageName()
                                + ";\" in the module-info of its module",
                        closed);
            }
        }
    }

    @Override
    public @Nullable Object invoke(Object self, Method method, @Nullable Object @Nullable [] given) throws Throwable {
        @Nullable Object[] arguments = given == null ? new @Nullable Object[0] : given;
        if (method.getDeclaringClass() == Object.class) {
            return switch (method.getName()) {
                case "equals" -> self == arguments[0];
                case "hashCode" -> System.identityHashCode(self);
                default -> type.getSimpleName() + " for \"" + need.by() + "\"";
            };
        }
        if (method.isDefault()) {
            return inherited(method).bindTo(self).invokeWithArguments(arguments);
        }
        method.setAccessible(true); // the interface need not be public
        if (SuspendingCalls.isSuspending(method)) {
            int last = arguments.length - 1;
            var taken = boundArguments(method, Arrays.copyOf(arguments, last));
            Promise<?> answer = CallDispatcher.Answer.ask(dispatcher, space, method, taken);
            return SuspendingCalls.await(answer, Objects.requireNonNull(arguments[last], "continuation"));
        }
        var taken = boundArguments(method, arguments);
        if (method.getReturnType() == Promise.class) {
            return CallDispatcher.Answer.ask(dispatcher, space, method, taken);
        }
        dispatcher.tell(new CallDispatcher.Call(method, taken, null));
        return null;
    }

    private static MethodHandle inherited(Method method) throws IllegalAccessException {
        Class<?> owner = method.getDeclaringClass();
        ServiceProxy.class.getModule().addReads(owner.getModule());
        return MethodHandles.privateLookupIn(owner, MethodHandles.lookup()).unreflectSpecial(method, owner);
    }

    @SuppressWarnings("unchecked") // the method declares the type of its callback
    private List<@Nullable Object> boundArguments(Method method, @Nullable Object[] arguments) {
        List<@Nullable Object> all = new ArrayList<>(arguments.length);
        for (int i = 0; i < arguments.length; i++) {
            Object argument = arguments[i];
            if (method.getParameterTypes()[i] == Callback.class && argument instanceof Callback<?> callback) {
                var place = new CallDispatcher.BoundCallback();
                dispatcher.bind((Callback<@Nullable Object>) callback, place);
                argument = place;
            }
            all.add(argument);
        }
        return Collections.unmodifiableList(all);
    }
}
