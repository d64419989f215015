package io.troupe.actor.guide;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorEnd;
import io.troupe.actor.ActorPool;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.InTestSpace;
import io.troupe.actor.Leftovers;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceMetrics;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.Supervision;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The sections "Failure, room, and blocking work", "Several spaces", "How it is doing" and "The end". */
class SpacesGuideTest extends InTestSpace {
    private final BlockingQueue<Object> shown = new LinkedBlockingQueue<>();

    interface Camera {
        Promise<String> shoot();

        void drop();
    }

    private static final class UsbCamera implements Camera {
        @Override
        public Promise<String> shoot() {
            return Promise.of("shot on " + Thread.currentThread().getName());
        }

        @Override
        public void drop() {
            throw new IllegalStateException("broken");
        }
    }

    private void show(Object what) {
        shown.add(what);
    }

    private void draw(String text) {
        show("drew " + text);
    }

    private void askForAnother(ActorEnd end) {
        assertThat(end).isInstanceOf(ActorEnd.Failed.class);
        show("another, please");
    }

    private Object next() throws InterruptedException {
        Object next = shown.poll(30, TimeUnit.SECONDS);
        assertThat(next).as("what was shown within 30 s").isNotNull();
        return next;
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void services_ofASpace_answerOnItsThread(@TempDir Path folder) throws Exception {
        Path map = Files.writeString(folder.resolve("map.txt"), "walls");
        var errors = new AtomicInteger();
        try (var space = ActorSpace.create(
                SpaceSettings.named("field").withOnError((where, error) -> errors.incrementAndGet()))) {
            var settings = ActorSettings.named("camera")
                    .withSupervision(Supervision.restart(3, Duration.ofSeconds(10)))
                    .withMailbox(1_000, Overflow.DROP_OLDEST);
            Camera camera = space.spawn(Camera.class, UsbCamera::new, settings);

            space.whenStopped(camera).then(end -> askForAnother(end));
            space.retry(5, Duration.ofSeconds(1), () -> camera.shoot()).then(this::show);
            space.offload(() -> Files.readString(map)).then(text -> draw(text));
            assertThat(List.of(next(), next())).containsExactlyInAnyOrder("shot on field", "drew walls");
            for (int failure = 0; failure < 4; failure++) {
                camera.drop();
            }
            assertThat(next()).isEqualTo("another, please");
            assertThat(errors).hasValue(4);
        }
    }

    @Test
    void pausesAndCases_ofASupervision() {
        var settings = ActorSettings.named("camera")
                .withSupervision(Supervision.restart(10, Duration.ofMinutes(1))
                        .withPauses(Duration.ofMillis(100), Duration.ofSeconds(30)) // 100 ms, 200 ms, 400 ms and so on
                        .on(IllegalArgumentException.class, Supervision.RESUME)
                        .withRequestsAndListeners());
        Camera camera = test.space().spawn(Camera.class, UsbCamera::new, settings);
        camera.drop();
        test.runQueued();
        Promise<String> shot = camera.shoot();
        test.advance(Duration.ofMillis(99));
        assertThat(shot.isDone()).isFalse();
        test.advance(Duration.ofMillis(1));
        assertThat(test.get(shot)).startsWith("shot on ");
        assertThat(takeErrors()).containsExactly("broken");
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void offload_doesNoMoreAtATimeThanItsLimit() throws Exception {
        var busy = new AtomicInteger();
        var most = new AtomicInteger();
        try (var space = ActorSpace.create(SpaceSettings.named("disk").withOffloadLimit(8))) {
            var works = new ArrayList<Promise<Integer>>();
            for (int work = 0; work < 200; work++) {
                works.add(space.offload(() -> {
                    most.accumulateAndGet(busy.incrementAndGet(), Math::max);
                    Thread.yield();
                    return busy.decrementAndGet();
                }));
            }
            assertThat(Promise.all(works).get(Duration.ofSeconds(30))).hasSize(200);
        }
        assertThat(most.get()).isBetween(1, 8);
    }

    static class Pilot extends Actor {
        private final Camera camera;

        Pilot(Camera camera) {
            this.camera = camera;
        }

        public Promise<String> look() {
            return camera.shoot()
                    .thenApply(image ->
                            image + ", seen on " + Thread.currentThread().getName());
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void proxies_workAcrossSpaces() throws Exception {
        try (var eyes = ActorSpace.create(SpaceSettings.named("eyes"));
                var wheels = ActorSpace.create(SpaceSettings.named("wheels"))) {
            Camera camera = eyes.spawn(Camera.class, UsbCamera::new);
            Pilot pilot = wheels.spawn(Pilot.class, () -> new Pilot(camera));
            show(pilot.look().get(Duration.ofSeconds(10)));
        }
        assertThat(next()).isEqualTo("shot on eyes, seen on wheels");
    }

    interface Finder {
        void learn(String colour);

        Promise<Integer> blobs(String image);
    }

    private static final class BlobFinder implements Finder {
        private final List<String> colours = new ArrayList<>();

        @Override
        public void learn(String colour) {
            if (colour.isEmpty()) {
                throw new IllegalArgumentException("colour is empty, expected a name");
            }
            colours.add(colour);
        }

        @Override
        public Promise<Integer> blobs(String image) {
            return Promise.of((int) colours.stream().filter(image::contains).count());
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void pool_spreadsTheWork() throws Exception {
        String image = "a red wall";
        try (ActorPool<Finder> pool =
                ActorPool.create(2, SpaceSettings.named("finder"), Finder.class, BlobFinder::new)) {
            Finder next = pool.roundRobin(); // each call goes to the next actor
            Finder own = pool.byFirstArgument(); // calls with equal first arguments go to one actor
            pool.broadcast().learn("red"); // to all; a request is fulfilled when all have answered
            show(next.blobs(image).get(Duration.ofSeconds(10)));
            show(own.blobs(image).get(Duration.ofSeconds(10)));
        } // closes the spaces finder-0 and finder-1
        assertThat(List.of(next(), next())).containsExactly(1, 1);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void pool_hasSettingsForItsActors() throws Exception {
        ActorSettings settings =
                ActorSettings.defaults().withSupervision(Supervision.restart(3, Duration.ofMinutes(1)));
        ActorPool<Finder> finders =
                ActorPool.create(2, SpaceSettings.named("finder"), Finder.class, BlobFinder::new, settings);
        int living = finders.living(); // 2: none has stopped
        assertThat(living).isEqualTo(2);
        finders.broadcast().learn("red");
        finders.broadcast().learn(""); // fails, and a new instance has learned nothing
        assertThat(finders.roundRobin().blobs("a red wall").get(Duration.ofSeconds(10)))
                .isZero();
        finders.close();
        assertThat(finders.living()).isZero();
    }

    @Test
    void metrics_countWhatWasLost() {
        ActorSpace space = test.space();
        Camera camera = test.spawn(Camera.class, UsbCamera::new);
        camera.drop();
        test.runQueued();
        space.stop(camera);
        test.runQueued();
        camera.drop();
        test.runQueued();
        SpaceMetrics metrics = space.metrics();
        long waiting = metrics.waiting(); // the result of the last probe: call it periodically
        Duration latency = metrics.latency();
        long lost = metrics.errors() + metrics.deadLetters();
        assertThat(lost).isEqualTo(2);
        assertThat(waiting).isZero();
        assertThat(latency).isGreaterThanOrEqualTo(Duration.ZERO);
        assertThat(takeErrors()).containsExactly("broken");
        assertThat(test.takeDeadLetters()).hasSize(1);
    }

    @Test
    void close_reportsWhatWasLeftUndone() throws Exception {
        var space = ActorSpace.create(
                SpaceSettings.named("short-lived").withOnDeadLetter(this::show).withoutThread());
        Heating.Thermostat heater = space.spawn(Heating.Thermostat.class, Heating.Heater::new);
        Promise<?> never = space.delay(Duration.ofHours(1));
        space.runQueued();
        space.execute(() -> {
            space.close(); // and these are queued behind it
            heater.set(18);
            heater.read().handle((degrees, error) -> error);
        });
        space.runQueued();
        Leftovers left = space.close(Duration.ofSeconds(5));
        if (!left.isEmpty()) {
            show(left);
        }
        assertThat(never.isRejected()).isTrue();
        assertThat(next()).hasToString("Thermostat.set(double) to Thermostat#1: space short-lived is closed");
        assertThat(next())
                .hasToString(
                        "1 messages, 1 requests, 0 open requests, 0 tasks, 1 timers and 0 sequential bodies, the first: [Thermostat.set(double) to Thermostat#1, Thermostat.read() of Thermostat#1]");
        assertThat(List.copyOf(shown)).isEmpty();
    }
}
