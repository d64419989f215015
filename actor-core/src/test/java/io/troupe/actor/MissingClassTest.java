package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.InputStream;
import java.time.Duration;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * A space runs even if a class that only monitors it cannot be loaded, as when memory or file handles are short at that
 * moment.
 */
@Tag("threads")
@Timeout(60)
class MissingClassTest {
    /** Loads actor-core again, except one class. */
    private static final class Without extends ClassLoader {
        private final String missing;

        Without(Class<?> missing) {
            super(MissingClassTest.class.getClassLoader());
            this.missing = missing.getName();
        }

        @Override
        protected Class<?> loadClass(String name, boolean resolve) throws ClassNotFoundException {
            if (name.equals(missing)) {
                throw new ClassNotFoundException(name);
            }
            synchronized (getClassLoadingLock(name)) {
                Class<?> loaded = findLoadedClass(name);
                if (loaded != null) {
                    return loaded;
                }
                return name.startsWith("io.troupe.actor.") ? define(name) : super.loadClass(name, resolve);
            }
        }

        private Class<?> define(String name) throws ClassNotFoundException {
            try (InputStream in = getResourceAsStream(name.replace('.', '/') + ".class")) {
                if (in == null) {
                    throw new ClassNotFoundException(name);
                }
                byte[] bytes = in.readAllBytes();
                return defineClass(name, bytes, 0, bytes.length);
            } catch (IOException broken) {
                throw new ClassNotFoundException(name, broken);
            }
        }
    }

    /** Whether a stall is reported while it lasts. */
    public static final class Stalling implements Callable<Boolean> {
        @Override
        public Boolean call() throws Exception {
            var reported = new CountDownLatch(1);
            var settings =
                    SpaceSettings.named("stalling").withOnStall(Duration.ofMillis(20), stall -> reported.countDown());
            try (var space = ActorSpace.create(settings)) {
                var release = new CountDownLatch(1);
                space.execute(() -> awaitQuietly(release));
                boolean seen = reported.await(10, TimeUnit.SECONDS);
                release.countDown();
                return seen;
            }
        }

        private static void awaitQuietly(CountDownLatch latch) {
            try {
                latch.await();
            } catch (InterruptedException interrupted) {
                throw new IllegalStateException(interrupted);
            }
        }
    }

    /** Whether a space works, and reports one error. */
    public static final class Serving implements Callable<Boolean> {
        @Override
        public Boolean call() throws Exception {
            var served = new CountDownLatch(1);
            try (var space = ActorSpace.create(SpaceSettings.named("serving").withOnError((where, error) -> {}))) {
                space.execute(served::countDown);
                return served.await(10, TimeUnit.SECONDS) && space.metrics().errors() == 1;
            }
        }
    }

    private static Object callWithout(Class<?> missing, Class<?> program) throws Exception {
        var loader = new Without(missing);
        var constructor = loader.loadClass(program.getName()).getDeclaredConstructor();
        return ((Callable<?>) constructor.newInstance()).call();
    }

    @Test
    void stall_isReportedWithoutTheClassOfTheFigures() throws Exception {
        assertThat(callWithout(RecorderEvents.SpaceFiguresEvent.class, Stalling.class))
                .isEqualTo(true);
    }

    @Test
    void space_servesUnwatchedWithoutAWatchdog() throws Exception {
        assertThat(callWithout(Watchdog.class, Serving.class)).isEqualTo(true);
    }
}
