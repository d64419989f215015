package io.troupe.actor;

import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.Recipient;
import io.troupe.actor.internal.Router;
import java.lang.invoke.MethodHandle;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.MethodType;
import java.lang.invoke.VarHandle;
import java.lang.reflect.Constructor;
import java.lang.reflect.Field;
import java.lang.reflect.Modifier;
import java.util.Objects;
import java.util.Optional;
import java.util.function.Supplier;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * The generated classes of an actor type, and how to create its proxies. One per type, retained as long as the type.
 */
abstract class ActorType {
    private static final ClassValue<Once> ACTORS = new OncePerType(ActorType::actorOf);
    private static final ClassValue<Once> POOLS = new OncePerType(ActorType::poolOf);

    private @Nullable String hookMessage; // written once, before another thread can see this object

    /** The type of a proxy that sends to the {@link Recipient} behind it. */
    static ActorType of(Class<?> type) {
        return ACTORS.get(type).get(type);
    }

    /** The type of a proxy that forwards to the actors of its {@link Router}. */
    static ActorType ofPool(Class<?> type) {
        return POOLS.get(type).get(type);
    }

    private static final class OncePerType extends ClassValue<Once> {
        private final Generator generator;

        OncePerType(Generator generator) {
            this.generator = generator;
        }

        @Override
        protected Once computeValue(Class<?> type) {
            return new Once(generator);
        }
    }

    private interface Generator {
        ActorType generate(Class<?> type, MethodHandles.Lookup lookup) throws ReflectiveOperationException;
    }

    /**
     * Classes can be defined only once: the first thread generates them, other threads wait, and a failure is
     * permanent, unless memory or stack was short.
     */
    private static final class Once {
        private static final int FRAMES_FOR_GENERATING = 1_000;

        private final Generator generator;
        private @Nullable ActorType made;
        private @Nullable ActorTypeException failure;

        Once(Generator generator) {
            this.generator = generator;
        }

        synchronized ActorType get(Class<?> type) {
            if (failure != null) {
                throw new ActorTypeException(String.valueOf(failure.getMessage()), failure);
            }
            if (made == null) {
                try {
                    checkStack(FRAMES_FOR_GENERATING); // a class whose first use fails there is broken for good
                    made = generate(type, generator);
                } catch (ActorTypeException e) {
                    failure = isTransient(e) ? null : e;
                    throw e;
                }
            }
            return made;
        }

        /** Throws a StackOverflowError if the caller's stack has fewer frames left. */
        private static int checkStack(int frames) {
            return frames == 0 ? 0 : 1 + checkStack(frames - 1);
        }

        /** True if there was not enough memory or stack: the next try may succeed. */
        private static boolean isTransient(Throwable failure) {
            for (Throwable cause = failure.getCause(); cause != null; cause = cause.getCause()) {
                if (cause instanceof VirtualMachineError) {
                    return true;
                }
            }
            return false;
        }
    }

    /**
     * Creates a proxy.
     *
     * @param target a {@link Recipient} or a {@link Router}, depending on the type
     */
    abstract <A> A newProxy(Object target);

    /**
     * A factory that refuses an implementation that extends {@link Actor}, if a message of the type would be a hook of
     * it too. (A class is refused by {@link ActorMethods}.)
     */
    final <A> Supplier<? extends A> checked(Class<A> type, Supplier<? extends A> factory) {
        String hook = hookMessage;
        if (hook == null) {
            return factory;
        }
        return () -> {
            A made = factory.get();
            if (made instanceof Actor) {
                throw new ActorTypeException(type.getSimpleName() + "." + hook + "() of actor type " + type.getName()
                        + " is a message, and in its implementation "
                        + made.getClass().getName()
                        + " also the hook Actor." + hook
                        + "(): give the message another name, or let the implementation not extend Actor");
            }
            return made;
        };
    }

    private static ActorType actorOf(Class<?> type, MethodHandles.Lookup lookup) throws ReflectiveOperationException {
        Class<?> proxyClass = new ProxyGenerator(type, ActorMethods.of(type), lookup).generate();
        return type.isInterface()
                ? new OfInterface(lookup, proxyClass, Recipient.class)
                : new OfClass(lookup, proxyClass, ProxyGenerator.CELL, Recipient.class);
    }

    private static ActorType poolOf(Class<?> type, MethodHandles.Lookup lookup) throws ReflectiveOperationException {
        Class<?> proxyClass = new PoolProxyGenerator(type, ActorMethods.of(type), lookup).generate();
        return type.isInterface()
                ? new OfInterface(lookup, proxyClass, Router.class)
                : new OfClass(lookup, proxyClass, PoolProxyGenerator.ROUTER_FIELD, Router.class);
    }

    private static ActorType generate(Class<?> type, Generator generator) {
        MethodHandles.Lookup lookup = TypeRules.check(type);
        try {
            ActorType made = generator.generate(type, lookup);
            made.hookMessage = ActorMethods.hookMessage(type).orElse(null);
            return made;
        } catch (ReflectiveOperationException | LinkageError | TypeNotPresentException e) {
            throw new ActorTypeException("the proxy of " + type.getName() + " cannot be made: " + e, e);
        }
    }

    private static final class OfInterface extends ActorType {
        private final MethodHandle constructor;

        OfInterface(MethodHandles.Lookup lookup, Class<?> proxyClass, Class<?> targetType)
                throws ReflectiveOperationException {
            constructor = lookup.findConstructor(proxyClass, MethodType.methodType(void.class, targetType))
                    .asType(MethodType.methodType(Object.class, Object.class));
        }

        @Override
        @SuppressWarnings("unchecked") // the proxy class was generated for A
        <A> A newProxy(Object target) {
            try {
                return (A) constructor.invokeExact(target);
            } catch (VirtualMachineError e) {
                throw e; // short of memory or stack
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
        private final Constructor<?> constructor;
        private final VarHandle targetField;

        OfClass(MethodHandles.Lookup lookup, Class<?> proxyClass, String field, Class<?> targetType)
                throws ReflectiveOperationException {
            constructor = constructorOfObject(proxyClass);
            targetField = lookup.findVarHandle(proxyClass, field, targetType);
        }

        @Override
        @SuppressWarnings("unchecked") // the proxy class was generated for A
        <A> A newProxy(Object target) {
            Object proxy;
            try {
                proxy = constructor.newInstance();
            } catch (ReflectiveOperationException e) {
                if (e.getCause() instanceof VirtualMachineError tooShort) {
                    throw tooShort; // of memory or stack
                }
                throw new AssertionError("the constructor of Object does not throw", e);
            }
            targetField.set(proxy, target);
            VarHandle.releaseFence(); // like a final field: every thread that receives the proxy sees its target
            return (A) proxy;
        }

        /**
         * A constructor for instances of a type that runs only the constructor of Object, as it is used for
         * deserialization. It is called by reflection because javac warns of each mention of its class.
         */
        private static Constructor<?> constructorOfObject(Class<?> type) throws ReflectiveOperationException {
            try {
                Class<?> factory = Class.forName("sun.reflect.ReflectionFactory");
                return (Constructor<?>) factory.getMethod(
                                "newConstructorForSerialization", Class.class, Constructor.class)
                        .invoke(
                                factory.getMethod("getReflectionFactory").invoke(null),
                                type,
                                Object.class.getConstructor());
            } catch (ClassNotFoundException e) {
                throw new ActorTypeException(
                        "the proxy of a class actor needs module jdk.unsupported, which this Java runtime does not have: "
                                + "link it with jdk.unsupported, or use an interface instead of "
                                + type.getSuperclass().getName(),
                        e);
            }
        }
    }

    /** The requirements on an actor type, apart from its methods; the error for a violation names the alternative. */
    private static final class TypeRules {
        private TypeRules() {}

        /** Checks a type and returns access to its package, for classes that have access to this library. */
        static MethodHandles.Lookup check(Class<?> type) {
            checkShape(type);
            if (!type.isInterface()) {
                checkFields(type);
            }
            Module library = ActorType.class.getModule();
            library.addReads(type.getModule()); // which may require this library, but not the other way round
            MethodHandles.Lookup lookup = lookupIn(type);
            checkSeesActors(type);
            library.addExports(Message.class.getPackageName(), type.getModule());
            return lookup;
        }

        private static void checkShape(Class<?> type) {
            String problem = null;
            if (type.isHidden()) {
                problem = "it is hidden, so that its proxy cannot name it";
            } else if (type.isInterface()) {
                if (type.isAnnotation()) {
                    problem = "it is an annotation";
                } else if (type.isSealed()) {
                    problem = "it is sealed, so that no proxy can implement it";
                }
            } else if (!Actor.class.isAssignableFrom(type)) {
                problem = "it is a class that does not extend " + Actor.class.getName()
                        + byInterface(type).orElse("; use an interface, or extend Actor");
            } else if (Modifier.isFinal(type.getModifiers()) || type.isSealed()) {
                problem = "it is final or sealed, so that its proxy cannot be a subclass (in Kotlin, make it open)"
                        + byInterface(type).orElse("");
            } else if (type.isAnonymousClass()) {
                problem = "it is anonymous";
            }
            if (problem != null) {
                throw new ActorTypeException(type.getName() + " cannot be an actor type: " + problem);
            }
        }

        /** How to spawn an implementation of an interface, which is the most frequent mistake. */
        private static Optional<String> byInterface(Class<?> type) {
            String name = type.getSimpleName();
            return Stream.<Class<?>>iterate(type, Objects::nonNull, Class::getSuperclass)
                    .flatMap(each -> Stream.of(each.getInterfaces()))
                    .filter(each -> !each.isSealed() && !each.getName().matches("(java|javax|kotlin)\\..*"))
                    .findFirst()
                    .map(Class::getSimpleName)
                    .map(its -> "; spawn it by its interface: spawn(" + its + ".class, " + name
                            + "::new), in Kotlin spawn<" + its + "> { " + name + "() }");
        }

        /**
         * The proxy has the same fields, which are never set. Code that reads a field of the proxy gets a default
         * value, and the actor does not see what is written there.
         */
        private static void checkFields(Class<?> type) {
            for (Class<?> each = type; each != null && each != Actor.class; each = each.getSuperclass()) {
                for (Field field : each.getDeclaredFields()) {
                    int modifiers = field.getModifiers();
                    if (!Modifier.isStatic(modifiers) && !Modifier.isPrivate(modifiers) && !field.isSynthetic()) {
                        throw new ActorTypeException(
                                "the field " + each.getSimpleName() + "." + field.getName()
                                        + " of actor type " + type.getName()
                                        + " can be reached through a proxy, where it is not the actor's: make it private, and let a method return a Promise of it");
                    }
                }
            }
        }

        /**
         * The proxy is linked by the type's class loader and module, which might not see this library, or see another
         * copy of it.
         */
        private static void checkSeesActors(Class<?> type) {
            Module home = Message.class.getModule();
            String problem = null;
            try {
                if (Class.forName(Message.class.getName(), false, type.getClassLoader()) != Message.class) {
                    problem = "sees another copy of it: load it once, in a parent of all loaders that use it";
                }
            } catch (ClassNotFoundException e) {
                problem = "does not see it: use an interface that you declare";
            }
            if (problem != null) {
                throw new ActorTypeException(type.getName()
                        + " cannot be an actor type: its proxy needs package " + Message.class.getPackageName()
                        + ", and its class loader " + type.getClassLoader() + " " + problem);
            }
            if (!type.getModule().canRead(home)) {
                throw new ActorTypeException(type.getName() + " cannot be an actor type: module "
                        + type.getModule().getName() + " does not read " + home
                        + "; write \"requires io.troupe.actor;\" in its module-info");
            }
        }

        private static MethodHandles.Lookup lookupIn(Class<?> type) {
            try {
                return MethodHandles.privateLookupIn(type, MethodHandles.lookup());
            } catch (IllegalAccessException e) {
                String module = type.getModule().getName();
                throw new ActorTypeException(
                        type.getName() + " cannot be an actor type: its proxy belongs into its package, and module "
                                + module
                                + " does not let it in; write \"opens " + type.getPackageName()
                                + ";\" in the module-info of " + module
                                + ", or use an interface that you declare",
                        e);
            }
        }
    }
}
