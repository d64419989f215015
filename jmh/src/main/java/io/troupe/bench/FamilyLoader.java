package io.troupe.bench;

import java.io.IOException;
import java.lang.reflect.Constructor;
import org.jspecify.annotations.Nullable;

/** Loads a class and its nested classes once more; all other classes are shared. See {@link Family} for the reason. */
final class FamilyLoader extends ClassLoader {
    private final Class<?> original;

    private FamilyLoader(Class<?> original) {
        super(original.getClassLoader());
        this.original = original;
    }

    /** An instance of a new copy of the class, made by its only public constructor. */
    static Family copy(Class<? extends Family> original, Object... arguments) throws ReflectiveOperationException {
        Constructor<?> constructor =
                new FamilyLoader(original).loadClass(original.getName()).getConstructors()[0];
        return (Family) constructor.newInstance(arguments);
    }

    @Override
    protected Class<?> loadClass(String name, boolean resolve) throws ClassNotFoundException {
        if (!name.equals(original.getName()) && !name.startsWith(original.getName() + "$")) {
            return super.loadClass(name, resolve);
        }
        synchronized (getClassLoadingLock(name)) {
            @Nullable Class<?> loaded = findLoadedClass(name);
            return loaded == null ? define(name) : loaded;
        }
    }

    private Class<?> define(String name) throws ClassNotFoundException {
        try (var file = getResourceAsStream(name.replace('.', '/') + ".class")) {
            if (file == null) {
                throw new ClassNotFoundException(name + " has no class file beside " + original.getName());
            }
            byte[] bytes = file.readAllBytes();
            return defineClass(name, bytes, 0, bytes.length);
        } catch (IOException failure) {
            throw new ClassNotFoundException(name + " cannot be read", failure);
        }
    }
}
