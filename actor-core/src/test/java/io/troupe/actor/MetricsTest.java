package io.troupe.actor;

import static io.troupe.actor.Concurrently.await;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.io.InputStream;
import java.lang.management.ManagementFactory;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.logging.Handler;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import javax.management.MBeanFeatureInfo;
import javax.management.MBeanServer;
import javax.management.ObjectName;
import jdk.jfr.Recording;
import jdk.jfr.consumer.RecordedEvent;
import jdk.jfr.consumer.RecordingFile;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.api.parallel.Isolated;

/** The figures, events and log lines of a space; and a space without the classes that only monitor it. */
@Isolated("reads the log")
class MetricsTest extends InTestSpace {
    private static final int LOOKS_UNTIL_COMPILED = 200_000;
    private static final Runnable NOTHING = () -> {};

    /** Runs tasks. */
    interface Worker {
        void work(Runnable task);
    }

    private static void fail() {
        throw new IllegalStateException("broken");
    }

    @Test
    void figures_ofASpaceWithoutThread_areExact() {
        SpaceMetrics metrics = test.space().metrics();
        Worker worker = test.spawn(Worker.class, () -> Runnable::run);
        long before = metrics.served();
        worker.work(NOTHING);
        worker.work(NOTHING);
        worker.work(MetricsTest::fail);
        Promise<?> delay = test.space().delay(Duration.ofSeconds(1));
        assertThat(metrics.waiting()).isEqualTo(4);
        test.runQueued();
        assertThat(metrics.served() - before).isEqualTo(4);
        assertThat(metrics)
                .hasToString("served 5, waiting 0, latency PT0S, actors 1, timers 1, errors 1, dead letters 0, "
                        + "abandoned 0, expired 0");
        stop(worker);
        worker.work(NOTHING);
        test.runQueued();
        assertThat(metrics.deadLetters()).isEqualTo(1);
        assertThat(metrics.actors()).isZero();
        test.advance(Duration.ofSeconds(1));
        assertThat(delay.isDone()).isTrue();
        test.takeProblems();
        test.takeDeadLetters();
    }

    /** Answers with the promise that it is given. */
    interface Asked {
        Promise<String> ask(Promise<String> answer);
    }

    @Test
    void requestsThatWereNotBegun_andTimeLimitsThatHavePassed_areCounted() {
        SpaceMetrics metrics = test.space().metrics();
        Asked asked = test.spawn(Asked.class, () -> answer -> answer);
        asked.ask(Promise.of("cancelled")).cancel();
        test.runQueued();
        assertThat(metrics.abandoned()).isEqualTo(1);
        test.run(() -> {
            asked.ask(new Deferred<>()).orTimeout(Duration.ofSeconds(1)).exceptionally(error -> "too late");
            asked.ask(new Deferred<>()).completeOnTimeout("instead", Duration.ofSeconds(1));
            asked.ask(Promise.of("in time")).orTimeout(Duration.ofSeconds(1));
        });
        test.advance(Duration.ofSeconds(1));
        assertThat(metrics.expired()).isEqualTo(2);
        assertThat(metrics.abandoned()).isEqualTo(1);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void actors_lookedAtAgainAndAgainFromOutside_areSeenToGo() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("watched"))) {
            Worker worker = space.spawn(Worker.class, () -> Runnable::run);
            Deferred<Boolean> begun = space.deferred();
            space.execute(() -> begun.resolve(true));
            begun.get(Duration.ofSeconds(30));
            SpaceMetrics metrics = space.metrics();
            var compiled = new CountDownLatch(LOOKS_UNTIL_COMPILED);
            var gone = new CountDownLatch(1);
            Thread.ofPlatform().daemon().start(() -> {
                while (compiled.getCount() > 0) { // a new loop each time, so that the compiler optimises it
                    lookUntil(metrics, 1);
                    compiled.countDown();
                }
                lookUntil(metrics, 0);
                gone.countDown();
            });
            compiled.await();
            space.stop(worker);
            assertThat(gone.await(60, TimeUnit.SECONDS)).isTrue();
        }
    }

    @Test
    void bean_hasTheFigures_untilTheSpaceIsClosed() throws Exception {
        var space = ActorSpace.create(
                SpaceSettings.named("a \"bean\"").withoutThread().withOnError((where, error) -> {}));
        space.registerBean();
        assertThatThrownBy(space::registerBean)
                .isInstanceOf(ActorException.class)
                .hasMessageStartingWith("the bean of space a \"bean\" cannot be registered: ");
        Worker worker = space.spawn(Worker.class, () -> Runnable::run);
        worker.work(NOTHING);
        worker.work(MetricsTest::fail);
        MBeanServer server = ManagementFactory.getPlatformMBeanServer();
        var name = new ObjectName("io.troupe:type=ActorSpace,name=\"a \\\"bean\\\"\"");
        assertThat(server.getAttribute(name, "Waiting")).isEqualTo(3L);
        space.runQueued();
        List<String> attributes = Arrays.stream(server.getMBeanInfo(name).getAttributes())
                .map(MBeanFeatureInfo::getName)
                .toList();
        assertThat(server.getAttributes(name, attributes.toArray(String[]::new)).asList())
                .hasToString("[Served = 3, Waiting = 0, LatencyMicros = 0, Actors = 1, Timers = 0, Errors = 1, "
                        + "DeadLetters = 0, Abandoned = 0, Expired = 0]");
        assertThatThrownBy(() -> server.getAttribute(name, "Speed")).hasMessageStartingWith("Speed, expected one of");
        space.close();
        assertThat(server.isRegistered(name)).isFalse();
    }

    private static void lookUntil(SpaceMetrics metrics, int actors) {
        while (metrics.actors() != actors) {}
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void figures_ofASpaceThatIsBehind_reportHowFar() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("behind").withoutStallLimit())) {
            Worker worker = space.spawn(Worker.class, () -> Runnable::run);
            var latch = new CountDownLatch(1);
            var served = new CountDownLatch(1);
            worker.work(() -> await(latch));
            for (int message = 0; message < 1000; message++) {
                worker.work(NOTHING);
            }
            Duration underWay = space.metrics().latency(); // sends the probe
            space.execute(served::countDown);
            latch.countDown();
            served.await();
            assertThat(underWay).isGreaterThanOrEqualTo(Duration.ZERO);
            assertThat(space.metrics().waiting()).isBetween(1000L, 1002L);
            assertThat(space.metrics().latency()).isPositive();
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void flightRecorder_getsErrorsDeadLettersStallsAndFigures(@TempDir Path folder) throws Exception {
        Path file = folder.resolve("space.jfr");
        var stalled = new CountDownLatch(1);
        try (var recording = new Recording()) {
            recording.start();
            try (var space = ActorSpace.create(SpaceSettings.named("recorded")
                    .withOnError((where, error) -> {})
                    .withOnDeadLetter(letter -> {})
                    .withOnStall(Duration.ofMillis(20), stall -> stalled.countDown()))) {
                Worker worker = space.spawn(Worker.class, () -> Runnable::run, ActorSettings.named("worker"));
                worker.work(MetricsTest::fail);
                worker.work(() -> await(stalled));
                space.stop(worker);
                worker.work(NOTHING);
            }
            recording.dump(file);
        }
        var events = RecordingFile.readAllEvents(file).stream()
                .filter(event -> event.getEventType().getName().startsWith("io.troupe."))
                .filter(event -> event.getString("space").equals("recorded")) // other tests have spaces too
                .toList();
        assertThat(named(events, "Error").getString("where")).isEqualTo("Worker.work(Runnable) of worker");
        assertThat(named(events, "DeadLetter").getString("reason")).contains("worker has stopped");
        assertThat(named(events, "Stall").getString("stack")).contains("CountDownLatch.await");
        assertThat(named(events, "SpaceFigures").getInt("actors")).isBetween(0, 1);
        assertThat(Files.size(file)).isPositive();
    }

    private static RecordedEvent named(List<RecordedEvent> events, String name) {
        return events.stream()
                .filter(event -> event.getEventType().getName().equals("io.troupe." + name))
                .findFirst()
                .orElseThrow(() -> new AssertionError("no " + name + " among " + events));
    }

    // ---- log lines, as java.util.logging prints them

    @Test
    void logLines_nameTheirSource_insteadOfALambda() throws Exception {
        var logger = Logger.getLogger(ActorSpace.class.getName());
        var kept = new Handler() {
            @Override
            public void publish(LogRecord line) {
                log.add(line.getSourceClassName() + " " + line.getSourceMethodName() + ": " + line.getMessage());
            }

            @Override
            public void flush() {}

            @Override
            public void close() {}
        };
        logger.addHandler(kept);
        logger.setUseParentHandlers(false);
        try {
            SpaceSettings.named("logged").onError().handle("here", new IllegalStateException("broken"));
        } finally {
            logger.setUseParentHandlers(true);
            logger.removeHandler(kept);
        }
        assertThat(log).containsExactly("io.troupe.actor.SpaceLog error: in here");
    }

    // ---- a class cannot be loaded, as when memory or file handles are short at that moment

    /** Loads actor-core again, except one class. */
    private static final class Without extends ClassLoader {
        private final String missing;

        Without(Class<?> missing) {
            super(MetricsTest.class.getClassLoader());
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
                space.execute(() -> await(release));
                boolean seen = reported.await(60, TimeUnit.SECONDS);
                release.countDown();
                return seen;
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
                return served.await(60, TimeUnit.SECONDS) && space.metrics().errors() == 1;
            }
        }
    }

    private static Object callWithout(Class<?> missing, Class<?> program) throws Exception {
        var loader = new Without(missing);
        var constructor = loader.loadClass(program.getName()).getDeclaredConstructor();
        return ((Callable<?>) constructor.newInstance()).call();
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void stall_isReportedWithoutTheClassOfTheFigures() throws Exception {
        assertThat(callWithout(RecorderEvents.SpaceFiguresEvent.class, Stalling.class))
                .isEqualTo(true);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void space_servesUnwatchedWithoutAWatchdog() throws Exception {
        assertThat(callWithout(Watchdog.class, Serving.class)).isEqualTo(true);
    }
}
