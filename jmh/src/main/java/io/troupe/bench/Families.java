package io.troupe.bench;

import java.io.IOException;
import java.lang.reflect.Constructor;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;

/** Twenty copies of a contender's {@link Family}: two hundred message types, for the workload {@code tellOfMany}. */
final class Families {
    private static final int COPIES = 20;

    /** The number of message types. */
    static final int TYPES = COPIES * Family.TYPES;

    private final CompletionLatch finish = new CompletionLatch();
    private final AtomicInteger busy = new AtomicInteger();
    private final List<Tally> tallies = new ArrayList<>();
    private final List<Family> families = new ArrayList<>();

    Families(Contender contender) throws Exception {
        for (int i = 0; i < COPIES; i++) {
            var tally = new Tally(this::familyDone);
            tallies.add(tally);
            families.add(contender.newFamily(tally));
        }
    }

    private void familyDone() {
        if (busy.decrementAndGet() == 0) {
            finish.reach();
        }
    }

    /**
     * Sends {@code messages}, a multiple of {@link #TYPES}, of all types in turn, and waits until the last one is
     * handled.
     */
    void tell(int messages) {
        finish.reset();
        busy.set(COPIES);
        for (Tally tally : tallies) {
            tally.expect(messages / COPIES);
        }
        for (int i = 0; i < messages / TYPES; i++) {
            for (Family family : families) {
                family.send(i);
            }
        }
        finish.await();
    }

    List<Family> all() {
        return List.copyOf(families);
    }

    /** The sum that each actor has added up. */
    List<Long> sums() {
        return tallies.stream().map(Tally::sum).toList();
    }

    /** An instance of a new copy of the class, made by its only public constructor. */
    static Family copy(Class<? extends Family> original, Object... arguments) throws ReflectiveOperationException {
        Constructor<?> constructor =
                new Loader(original).loadClass(original.getName()).getConstructors()[0];
        return (Family) constructor.newInstance(arguments);
    }

    /**
     * Loads a class and its nested classes once more; all other classes are shared. See {@link Family} for the reason.
     */
    private static final class Loader extends ClassLoader {
        private final Class<?> original;

        private Loader(Class<?> original) {
            super(original.getClassLoader());
            this.original = original;
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
}
