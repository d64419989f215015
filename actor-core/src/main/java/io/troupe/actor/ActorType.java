package io.troupe.actor;

import java.lang.invoke.MethodHandle;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.MethodType;
import java.lang.invoke.VarHandle;
import org.jspecify.annotations.Nullable;
import org.objenesis.ObjenesisStd;
import org.objenesis.instantiator.ObjectInstantiator;

/**
 * The generated classes of an actor type, and how to create its proxies. One per type, retained as long as the type.
 */
abstract class ActorType {
    private static final ClassValue<Once> TYPES = new ClassValue<>() {
        @Override
        protected Once computeValue(Class<?> type) {
            return new Once();
        }
    };

    static ActorType of(Class<?> type) {
        return TYPES.get(type).get(type);
    }

    /**
     * Classes can be defined only once: the first thread generates them, other threads wait, and a failure is
     * permanent.
     */
    private static final class Once {
        private @Nullable ActorType made;
        private @Nullable ActorTypeException failure;

        synchronized ActorType get(Class<?> type) {
            if (failure != null) {
                throw new ActorTypeException(String.valueOf(failure.getMessage()), failure);
            }
            if (made == null) {
                try {
                    made = generate(type);
                } catch (ActorTypeException e) {
                    failure = e;
                    throw e;
                }
            }
            return made;
        }
    }

    /** Creates a proxy that sends to the cell. */
    abstract <A> A newProxy(ActorCell cell);

    private static ActorType generate(Class<?> type) {
        MethodHandles.Lookup lookup = TypeRules.check(type);
        try {
            Class<?> proxyClass = new ProxyGenerator(type, ActorMethods.of(type), lookup).generate();
            return type.isInterface() ? new OfInterface(lookup, proxyClass) : new OfClass(lookup, proxyClass);
        } catch (ReflectiveOperationException | LinkageError | TypeNotPresentException e) {
            throw new ActorTypeException("the proxy of " + type.getName() + " cannot be made: " + e, e);
        }
    }

    private static final class OfInterface extends ActorType {
        private final MethodHandle constructor;

        OfInterface(MethodHandles.Lookup lookup, Class<?> proxyClass) throws ReflectiveOperationException {
            constructor = lookup.findConstructor(proxyClass, MethodType.methodType(void.class, ActorCell.class))
                    .asType(MethodType.methodType(Object.class, ActorCell.class));
        }

        @Override
        @SuppressWarnings("unchecked") // the proxy class was generated for A
        <A> A newProxy(ActorCell cell) {
            try {
                return (A) constructor.invokeExact(cell);
            } catch (Throwable e) {
                throw new AssertionError("a generated constructor does not throw", e);
            }
        }
    }

    /**
     * The proxy of a class actor is a subclass. It is created without running the constructors of the class, which are
     * for the real actor.
     */
    private static final class OfClass extends ActorType {
        private final ObjectInstantiator<?> instantiator;
        private final VarHandle cellField;

        OfClass(MethodHandles.Lookup lookup, Class<?> proxyClass) throws ReflectiveOperationException {
            instantiator = new ObjenesisStd(false).getInstantiatorOf(proxyClass);
            cellField = lookup.findVarHandle(proxyClass, ProxyGenerator.CELL, ActorCell.class);
        }

        @Override
        @SuppressWarnings("unchecked") // the proxy class was generated for A
        <A> A newProxy(ActorCell cell) {
            Object proxy = instantiator.newInstance();
            cellField.set(proxy, cell);
            VarHandle.releaseFence(); // like a final field: every thread that receives the proxy sees its cell
            return (A) proxy;
        }
    }
}
