package io.troupe.actor;

import java.lang.invoke.MethodHandles;
import java.lang.reflect.Field;
import java.lang.reflect.Modifier;

/** The requirements on an actor type, apart from its methods; the error for a violation names the alternative. */
final class TypeRules {
    private TypeRules() {}

    /** Checks a type and returns access to its package. */
    static MethodHandles.Lookup check(Class<?> type) {
        checkShape(type);
        if (!type.isInterface()) {
            checkFields(type);
        }
        MethodHandles.Lookup lookup = lookupIn(type);
        checkSeesActors(type);
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
                    + "; use an interface, or extend Actor";
        } else if (Modifier.isFinal(type.getModifiers()) || type.isSealed()) {
            problem = "it is final or sealed, so that its proxy cannot be a subclass (in Kotlin, make it open)";
        } else if (type.isAnonymousClass()) {
            problem = "it is anonymous";
        }
        if (problem != null) {
            throw new ActorTypeException(type.getName() + " cannot be an actor type: " + problem);
        }
    }

    /**
     * The proxy has the same fields, which are never set. Code that reads a field of the proxy gets a default value,
     * and the actor does not see what is written there.
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
     * The proxy is linked by the type's class loader and module, which might not see this library, or see another copy
     * of it.
     */
    private static void checkSeesActors(Class<?> type) {
        Module home = Message.class.getModule();
        String problem = null;
        try {
            if (Class.forName(Message.class.getName(), false, type.getClassLoader()) != Message.class) {
                problem = "sees another copy of it: load it once, in a parent of all loaders that use it";
            }
        } catch (ClassNotFoundException e) {
            problem = "does not see it: use an interface of your own";
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
                            + ", or use an interface of your own",
                    e);
        }
    }
}
