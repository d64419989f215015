package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.InputStream;
import java.lang.ref.WeakReference;
import java.security.ProtectionDomain;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * Code that comes and goes, as that of a web application or a plug-in: the threads of its spaces have its context class
 * loader, and nothing of it stays behind after its end. In another JVM, because it has to be the first user.
 */
@Timeout(value = 5, unit = TimeUnit.MINUTES)
class UnloadingTest {
    private static final Duration LIMIT = Duration.ofMinutes(1);
    private static final int ROUNDS = 300; // idle threads end after 10 to 20 s

    public interface Greeter {
        Promise<String> greet(String name);

        void count(Callback<Integer> numbers);
    }

    /** The ways into the library that code of a plug-in may take first. */
    enum Use {
        GLOBAL_SPACE,
        CREATED_SPACE,
        OFFLOADED_WORK,
        SEQUENTIAL_BODY,
        TIME_LIMIT_FROM_OUTSIDE,
        STREAM_AND_TOPIC,
        POOL,
        WATCHED_SPACE,
        FUTURE
    }

    /** A plug-in; loaded by a loader that is made for it. */
    public static final class Plugin {
        /** An actor of the plug-in, whose factory refers to the plug-in. */
        static final class Polite extends Actor implements Greeter {
            @Override
            public Promise<String> greet(String name) {
                return Promise.of("hello " + name);
            }

            @Override
            public void count(Callback<Integer> numbers) {
                numbers.next(1);
                numbers.finish();
            }
        }

        public static void use(String way) throws Exception {
            Use use = Use.valueOf(way);
            if (use == Use.GLOBAL_SPACE) {
                ActorSpace space = ActorSpace.global();
                use(space, use);
            } else {
                var settings = SpaceSettings.named("plugin");
                try (ActorSpace space = ActorSpace.create(
                        use == Use.WATCHED_SPACE
                                ? settings.withOnStall(Duration.ofMillis(50), stall -> {})
                                : settings)) {
                    use(space, use);
                }
            }
        }

        private static void use(ActorSpace space, Use use) throws Exception {
            Greeter greeter = space.spawn(Greeter.class, Polite::new);
            greeter.greet("Ada").get(LIMIT);
            switch (use) {
                case GLOBAL_SPACE, CREATED_SPACE, WATCHED_SPACE -> {}
                case OFFLOADED_WORK -> space.offload(() -> "done").get(LIMIT);
                case SEQUENTIAL_BODY ->
                    space.sequential(() -> greeter.greet("Bob").await()).get(LIMIT);
                case TIME_LIMIT_FROM_OUTSIDE ->
                    greeter.greet("Cyd").orTimeout(LIMIT).get(LIMIT);
                case STREAM_AND_TOPIC -> {
                    var ended = new CountDownLatch(1);
                    greeter.count(new Callback.Stream<>(value -> {}, end -> ended.countDown()));
                    ended.await();
                    var topic = Topic.<Integer>of(space, "numbers");
                    topic.subscribe(value -> {});
                    topic.publish(1);
                }
                case POOL -> {
                    try (var pool = ActorPool.create(2, SpaceSettings.named("pool"), Greeter.class, Polite::new)) {
                        pool.roundRobin().greet("Dan").get(LIMIT);
                    }
                }
                case FUTURE -> greeter.greet("Eve").toCompletableFuture().get(1, TimeUnit.MINUTES);
            }
            space.stop(greeter);
            space.whenStopped(greeter).get(LIMIT);
        }
    }

    /** Defines the classes of this test anew, and leaves the others to its parent. */
    private static final class PluginLoader extends ClassLoader {
        PluginLoader() {
            super(UnloadingTest.class.getClassLoader());
        }

        @Override
        protected Class<?> loadClass(String name, boolean resolve) throws ClassNotFoundException {
            if (!name.startsWith(UnloadingTest.class.getName())) {
                return super.loadClass(name, resolve);
            }
            Class<?> known = findLoadedClass(name);
            if (known != null) {
                return known;
            }
            try (InputStream in = getParent().getResourceAsStream(name.replace('.', '/') + ".class")) {
                if (in == null) {
                    throw new ClassNotFoundException(name);
                }
                byte[] bytes = in.readAllBytes();
                // a separate domain, as each jar has
                return defineClass(name, bytes, 0, bytes.length, new ProtectionDomain(null, null, this, null));
            } catch (IOException failure) {
                throw new ClassNotFoundException(name, failure);
            }
        }
    }

    /** Runs in another JVM: each use by a plug-in that is the first to make it. */
    public static void main(String[] none) throws Exception {
        for (Use use : Use.values()) {
            WeakReference<ClassLoader> loader = load(use.name());
            for (int round = 0; loader.get() != null && round < ROUNDS; round++) {
                System.gc();
                TimeUnit.MILLISECONDS.sleep(100);
            }
            System.out.println(use + (loader.get() == null ? ": unloaded" : ": still there"));
        }
        System.exit(0);
    }

    private static WeakReference<ClassLoader> load(String use) throws Exception {
        var loader = new PluginLoader();
        var plugin = loader.loadClass(Plugin.class.getName());
        Thread.currentThread().setContextClassLoader(loader);
        try {
            plugin.getMethod("use", String.class).invoke(null, use);
        } finally {
            Thread.currentThread().setContextClassLoader(ClassLoader.getSystemClassLoader());
        }
        return new WeakReference<>(loader);
    }

    @Test
    void plugin_isUnloaded_afterItsEnd_whateverItHasUsedFirst() throws Exception {
        assertThat(ChildJvm.run(List.of("-Xmx64m", "-XX:+UseSerialGC"), UnloadingTest.class)
                        .lines())
                .containsExactly(
                        Stream.of(Use.values()).map(use -> use + ": unloaded").toArray(String[]::new));
    }

    /** Once more, with a longer delay, if it was over before the continuation was registered. */
    private static String loaderAtTheEndOfADelay(ActorSpace space) throws Exception {
        Thread mine = Thread.currentThread();
        for (Duration delay = Duration.ofMillis(10); ; delay = delay.multipliedBy(2)) {
            var expired = new CompletableFuture<String>();
            space.delay(delay)
                    .toCompletableFuture()
                    .thenRun(() -> expired.complete(Thread.currentThread() == mine ? "" : loaderHere()));
            String loader = expired.get(1, TimeUnit.MINUTES);
            if (!loader.isEmpty()) {
                return loader;
            }
        }
    }

    private static String loaderHere() {
        ClassLoader loader = Thread.currentThread().getContextClassLoader();
        return loader == null ? "none" : String.valueOf(loader.getName());
    }

    @Test
    void threadsOfASpace_haveTheContextClassLoaderOfItsCreator() throws Exception {
        var mine = new ClassLoader("mine", UnloadingTest.class.getClassLoader()) {};
        Thread creator = Thread.currentThread();
        ClassLoader before = creator.getContextClassLoader();
        creator.setContextClassLoader(mine);
        try (var space = ActorSpace.create(SpaceSettings.named("with loader"))) {
            creator.setContextClassLoader(before);
            var inTurn = new CompletableFuture<String>();
            var offloaded = new CompletableFuture<@Nullable Promise<String>>();
            space.execute(() -> {
                inTurn.complete(loaderHere());
                offloaded.complete(space.offload(UnloadingTest::loaderHere));
            });
            assertThat(inTurn.get(1, TimeUnit.MINUTES)).isEqualTo("mine");
            assertThat(offloaded.get(1, TimeUnit.MINUTES).get(LIMIT)).isEqualTo("mine");
            assertThat(space.sequential(UnloadingTest::loaderHere).get(LIMIT)).isEqualTo("mine");
            assertThat(loaderAtTheEndOfADelay(space)).isEqualTo("mine");
        } finally {
            creator.setContextClassLoader(before);
        }
    }
}
