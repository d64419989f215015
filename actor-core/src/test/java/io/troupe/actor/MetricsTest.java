package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import jdk.jfr.Recording;
import jdk.jfr.consumer.RecordedEvent;
import jdk.jfr.consumer.RecordingFile;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

class MetricsTest {
    private static final int LOOKS_UNTIL_COMPILED = 200_000;

    interface Worker {
        void work();

        void fail();

        void waitFor(CountDownLatch latch);
    }

    static final class Working implements Worker {
        @Override
        public void work() {}

        @Override
        public void fail() {
            throw new IllegalStateException("broken");
        }

        @Override
        public void waitFor(CountDownLatch latch) {
            try {
                latch.await();
            } catch (InterruptedException e) {
                throw new IllegalStateException(e);
            }
        }
    }

    @Test
    void figures_ofASpaceCrankedByHand_areExact() {
        try (var test = new TestSpace()) {
            SpaceMetrics metrics = test.space().metrics();
            Worker worker = test.spawn(Worker.class, Working::new);
            long before = metrics.served();
            worker.work();
            worker.work();
            worker.fail();
            Promise<?> delay = test.space().delay(Duration.ofSeconds(1));
            assertThat(metrics.waiting()).isEqualTo(4);
            test.crank();
            assertThat(metrics.waiting()).isZero();
            assertThat(metrics.served() - before).isEqualTo(4);
            assertThat(metrics.actors()).isEqualTo(1);
            assertThat(metrics.timers()).isEqualTo(1);
            assertThat(metrics.errors()).isEqualTo(1);
            test.space().stop(worker);
            test.crank();
            worker.work();
            test.crank();
            assertThat(metrics.deadLetters()).isEqualTo(1);
            assertThat(metrics.actors()).isZero();
            test.advance(Duration.ofSeconds(1));
            assertThat(delay.isDone()).isTrue();
            test.takeProblems();
            test.takeDeadLetters();
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void actors_lookedAtAgainAndAgainFromOutside_areSeenToGo() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("watched"))) {
            Worker worker = space.spawn(Worker.class, Working::new);
            var begun = new Deferred<Boolean>(space);
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
            assertThat(gone.await(20, TimeUnit.SECONDS)).isTrue();
        }
    }

    private static void lookUntil(SpaceMetrics metrics, int actors) {
        while (metrics.actors() != actors) {}
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void figures_ofASpaceThatIsBehind_reportHowFar() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("behind").withOnStall(Duration.ZERO, stall -> {}))) {
            Worker worker = space.spawn(Worker.class, Working::new);
            var latch = new CountDownLatch(1);
            var served = new CountDownLatch(1);
            worker.waitFor(latch);
            for (int message = 0; message < 1000; message++) {
                worker.work();
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
                Worker worker = space.spawn(Worker.class, Working::new, ActorSettings.named("worker"));
                worker.fail();
                worker.waitFor(stalled);
                space.stop(worker);
                worker.work();
            }
            recording.dump(file);
        }
        var events = RecordingFile.readAllEvents(file).stream()
                .filter(event -> event.getEventType().getName().startsWith("io.troupe."))
                .filter(event -> event.getString("space").equals("recorded")) // other tests have spaces too
                .toList();
        assertThat(named(events, "io.troupe.Error").getString("where")).isEqualTo("Worker.fail() of worker");
        assertThat(named(events, "io.troupe.DeadLetter").getString("reason")).contains("worker has stopped");
        assertThat(named(events, "io.troupe.Stall").getString("stack")).contains("CountDownLatch.await");
        assertThat(named(events, "io.troupe.SpaceFigures").getInt("actors")).isBetween(0, 1);
        assertThat(Files.size(file)).isPositive();
    }

    private static RecordedEvent named(java.util.List<RecordedEvent> events, String name) {
        return events.stream()
                .filter(event -> event.getEventType().getName().equals(name))
                .findFirst()
                .orElseThrow(() -> new AssertionError("no " + name + " among " + events));
    }
}
