package io.troupe.actor.guide;

import static io.troupe.actor.Concurrently.LONG;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.InTestSpace;
import io.troupe.actor.Outcome;
import io.troupe.actor.Promise;
import io.troupe.actor.Schedule;
import io.troupe.actor.Topic;
import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.Probe;
import io.troupe.actor.testkit.TestSpace;
import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The sections of the guide on actors, promises, sequential bodies, callbacks, topics, timers and testing. */
class ActorsGuideTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);

    private void show(@Nullable Object what) {
        log.add(String.valueOf(what));
    }

    private void done() {
        log.add("done");
    }

    // ---- an interface and an object, or a class

    private static String printedBy(Consumer<String[]> main) {
        PrintStream console = System.out;
        var printed = new ByteArrayOutputStream();
        System.setOut(new PrintStream(printed, true, StandardCharsets.UTF_8));
        try {
            main.accept(new String[0]);
        } finally {
            System.setOut(console);
        }
        return printed.toString(StandardCharsets.UTF_8).strip();
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void programsOfTheReadmeAndTheGuide_printBeforeTheyEnd() {
        assertThat(printedBy(Hello::main)).isEqualTo("5");
        assertThat(printedBy(Heating::main)).isEqualTo("21.5");
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void thermostat_inTheGlobalSpace_takesMessages_andAnswersRequests() throws Exception {
        var shown = new Deferred<String>();
        Heating.Thermostat heater = ActorSpace.global().spawn(Heating.Thermostat.class, Heating.Heater::new);
        heater.set(21.5);
        heater.read()
                .then(degrees ->
                        shown.resolve(degrees + " on " + Thread.currentThread().getName()));
        assertThat(shown.get(LONG)).isEqualTo("21.5 on actor-space");
        ActorSpace.global().stop(heater);
    }

    static class Blinker extends Actor {
        private boolean on;

        @Override
        protected void started() {
            context().every(Duration.ofMillis(500), () -> on = !on);
        }

        public Promise<Boolean> isOn() {
            return Promise.of(on);
        }

        public Promise<Boolean> isOnLater() {
            return ((Blinker) self()).isOn(); // a message to itself, not a call
        }
    }

    @Test
    void blinker_blinks_byTheManualClock() {
        try (var test = new TestSpace()) { // no thread, and a manual clock
            Blinker blinker = test.spawn(Blinker.class, Blinker::new);
            test.advance(Duration.ofMillis(1_200));
            assertThat(test.get(blinker.isOn())).isFalse(); // on at 500 ms, off at 1000 ms
        }
    }

    @Test
    void messageToItself_isNoCall_andAnswersAsOne() {
        Blinker blinker = test.spawn(Blinker.class, Blinker::new);
        Promise<Boolean> later = blinker.isOnLater();
        long before = test.space().metrics().served();
        assertThat(test.get(later)).isFalse();
        assertThat(test.space().metrics().served() - before).isGreaterThanOrEqualTo(2); // itself, and what it sent
    }

    // ---- promises

    private static final Image DARK = new Image(0);
    private static final Image BRIGHT = new Image(2);

    record Image(int blobs) {}

    interface Camera {
        default void turn(int degrees) {}

        Promise<Image> shoot();
    }

    interface Finder {
        Promise<List<String>> blobs(Image image);
    }

    private void steer(List<String> blobs) {
        show(blobs);
    }

    private void shootFindAndSteer(Camera camera, Finder finder) {
        camera.shoot()
                .thenCompose(image -> finder.blobs(image)) // calls the next actor
                .orTimeout(Duration.ofSeconds(1))
                .exceptionally(error -> List.of())
                .then(blobs -> steer(blobs));
    }

    @Test
    void chain_asksTheNextOne_andStandsInForAnAnswerThatDoesNotCome() {
        Probe<Camera> camera = test.probe(Camera.class);
        Probe<Finder> finder = test.probe(Finder.class);
        shootFindAndSteer(camera.actor(), finder.actor());
        camera.answer(BRIGHT);
        finder.expectCall("blobs(Image[blobs=2])");
        finder.answer(List.of("red", "blue"));
        assertThat(log).containsExactly("[red, blue]");
        shootFindAndSteer(camera.actor(), finder.actor());
        test.advance(SECOND);
        assertThat(log).containsExactly("[red, blue]", "[]");
        assertThat(camera.takeUnanswered()).hasSize(1);
    }

    /** The source of pictures. */
    private record Driver(List<Consumer<Image>> listeners) {
        void onFrame(Consumer<Image> listener) {
            listeners.add(listener);
        }
    }

    private record DrivenCamera(Driver driver) implements Camera {
        @Override
        public Promise<Image> shoot() {
            var image = new Deferred<Image>();
            driver.onFrame(image::resolve); // from any thread; the first outcome counts
            return image;
        }
    }

    @Test
    void deferred_isSettledByTheFirstFrame() {
        var driver = new Driver(new ArrayList<>());
        Camera camera = test.spawn(Camera.class, () -> new DrivenCamera(driver));
        Promise<Image> image = camera.shoot();
        test.runQueued();
        assertThat(image.isDone()).isFalse();
        driver.listeners.forEach(each -> each.accept(BRIGHT));
        driver.listeners.forEach(each -> each.accept(DARK));
        assertThat(test.get(image)).isEqualTo(BRIGHT);
    }

    interface Door {
        Promise<Boolean> open();

        Promise<Boolean> close();
    }

    interface Rover {
        Promise<String> drive();
    }

    @Test
    void eventually_closesTheDoor() {
        Probe<Door> probe = test.probe(Door.class);
        Probe<Rover> driver = test.probe(Rover.class);
        Door door = probe.actor();
        Rover robot = driver.actor();
        Promise<String> end = door.open().thenCompose(open -> robot.drive()).eventually(() -> door.close());
        probe.expectCall("open()");
        probe.answer(true);
        driver.reject(new IllegalStateException("stuck"));
        probe.expectCall("close()");
        assertThat(end.isDone()).isFalse();
        probe.answer(true);
        assertThat(test.error(end)).hasMessage("stuck");
    }

    @Test
    void combinators_andConversions_answerWhatTheyAreSaidTo() {
        Camera left = test.spawn(Camera.class, () -> () -> Promise.failed(new IllegalStateException("no light")));
        Camera right = test.spawn(Camera.class, () -> () -> Promise.of(BRIGHT));

        Promise<List<Image>> both = Promise.all(List.of(left.shoot(), right.shoot()));
        Promise<Image> either = Promise.any(List.of(left.shoot(), right.shoot()));
        Promise<Image> sooner = Promise.race(List.of(left.shoot(), right.shoot()));
        Promise<List<Outcome<Image>>> ends = Promise.allSettled(List.of(left.shoot(), right.shoot()));

        CompletableFuture<Image> future = either.toCompletableFuture();
        Promise<Image> promise = Promise.from(future);

        assertThat(test.error(both)).hasMessage("no light");
        assertThat(test.get(either)).isEqualTo(BRIGHT);
        assertThat(test.error(sooner)).hasMessage("no light");
        assertThat(test.get(ends)).hasSize(2).element(1).isEqualTo(new Outcome.Fulfilled<>(BRIGHT));
        assertThat(future).isCompletedWithValue(BRIGHT);
        assertThat(test.get(promise)).isEqualTo(BRIGHT);
    }

    interface Greeter {
        Promise<String> greet(String name);

        default void remember(String name) {}
    }

    @Test
    void timeout_namesCallerRequestAndProgress() {
        Greeter greeter = test.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
        class Robot extends Actor {
            public void askWhenBusy() {
                for (int call = 0; call < 259; call++) { // timers run after 256 of them
                    greeter.remember("Ada");
                }
                greeter.greet("x").orTimeout(SECOND).handle((text, late) -> log.add(late.getMessage()));
                test.clock().advance(SECOND);
            }
        }
        test.spawn(Robot.class, Robot::new).askWhenBusy();
        test.runQueued();
        assertThat(log)
                .containsExactly(
                        "no answer to Robot#2 within PT1S from Greeter.greet(String) of Greeter#1, which has not begun it: 3 calls come first");
    }

    // ---- sequential and await

    interface Wheels {
        Promise<Boolean> goTo(String place);
    }

    private static class Guard extends Actor {
        private final Wheels robot;
        private final Camera camera;

        Guard(Probe<Wheels> wheels, Probe<Camera> eyes) {
            robot = wheels.actor();
            camera = eyes.actor();
        }

        public Promise<Integer> patrol(List<String> places) {
            return context().space().sequential(() -> {
                int blobs = 0;
                for (String place : places) {
                    robot.goTo(place).await();
                    blobs += camera.shoot().await().blobs();
                }
                return blobs;
            });
        }

        public Promise<String> name() {
            return Promise.of("guard");
        }
    }

    @Test
    void patrol_goesStraightOn_whileItsActorAnswersOthers() {
        Probe<Wheels> wheels = test.probe(Wheels.class);
        Probe<Camera> eyes = test.probe(Camera.class);
        Guard guard = test.spawn(Guard.class, () -> new Guard(wheels, eyes));
        Promise<Integer> blobs = guard.patrol(List.of("door", "window"));
        wheels.expectCall("goTo(door)");
        assertThat(test.get(guard.name())).isEqualTo("guard");
        eyes.expectNoCall();
        wheels.answer(true);
        eyes.answer(new Image(2));
        wheels.expectCall("goTo(window)");
        wheels.answer(true);
        eyes.answer(new Image(5));
        assertThat(test.get(blobs)).isEqualTo(7);
    }

    // ---- callbacks and topics

    interface Robot {
        void wander(Callback<Integer> colours);
    }

    @Test
    void callbacks_bringEveryResult_untilTheyAreCancelled() {
        var readers = new ArrayList<Callback<Integer>>();
        Robot robot = test.spawn(Robot.class, () -> readers::add);
        var stream = new Callback.Stream<Integer>(this::show, end -> done()); // notified of the end; can be cancelled
        robot.wander(stream);
        stream.cancel(); // the robot sees colours.isCancelled()
        robot.wander(
                (colour, error) -> show(colour)); // as the paper writes it: not notified of an end without an error
        test.runQueued();
        assertThat(readers).extracting(Callback::isCancelled).containsExactly(true, false);
        readers.forEach(colours -> colours.next(255));
        readers.getLast().next(16711680);
        test.runQueued();
        assertThat(log).containsExactly("done", "255", "16711680");
    }

    record Scan(double nearestMetres) {}

    private void avoid(Scan scan) {
        show(scan);
    }

    @Test
    void topic_reachesItsSubscribers_andTheLateOnesToo() {
        ActorSpace space = test.space();
        var scan = new Scan(0.4);

        Topic<Scan> scans = Topic.latest(space, "laser");

        int readers = scans.publish(scan); // the number of subscribers; 0 is no error
        var subscription = scans.subscribe(heard -> avoid(heard));
        subscription.cancel(); // from any thread; no more values arrive, not even queued ones
        scans.subscribe(new Callback.Stream<>(this::avoid, end -> done())); // is also notified of finish() and fail(..)
        assertThat(readers).isZero();
        test.runQueued();
        assertThat(log).containsExactly("Scan[nearestMetres=0.4]");
        assertThat(scans.publish(new Scan(0.3))).isEqualTo(1);
        scans.finish();
        test.runQueued();
        assertThat(log).containsExactly("Scan[nearestMetres=0.4]", "Scan[nearestMetres=0.3]", "done");
    }

    @Test
    void slowSubscriber_skipsWhatIsOld() {
        ActorSpace space = test.space();
        Topic<Scan> scans = Topic.of(space, "laser");
        Robot robot = test.spawn(Robot.class, () -> colours -> {
            for (int colour = 0; colour < 20; colour++) {
                colours.next(colour);
            }
        });

        var newest = scans.subscribe(1, this::avoid); // the newest only
        robot.wander(new Callback.Stream<>(16, this::show, end -> done()));
        long dropped = newest.dropped();

        scans.publish(new Scan(0.5));
        scans.publish(new Scan(0.4));
        assertThat(dropped).isZero();
        assertThat(newest.dropped()).isOne();
        test.runQueued();
        assertThat(log).hasSize(17).startsWith("Scan[nearestMetres=0.4]", "4").endsWith("19");
    }

    // ---- timers

    private class Listener extends Actor {
        public void heard() {
            context().after("silence", Duration.ofSeconds(3), this::stopMotors); // three seconds after the last word
        }

        public void rest() {
            context().cancelTimer("silence");
        }

        private void stopMotors() {
            log.add("stopped at " + context().space().clock().nanos() / 1_000_000_000);
        }
    }

    @Test
    void timerWithAKey_beginsAnew_andCanBeTakenBack() {
        Listener listener = test.spawn(Listener.class, Listener::new);
        for (int heard = 0; heard < 2; heard++) {
            listener.heard();
            test.advance(Duration.ofSeconds(2));
        }
        assertThat(log).isEmpty();
        test.advance(SECOND);
        assertThat(log).containsExactly("stopped at 5");
        listener.heard();
        listener.rest();
        test.advance(Duration.ofSeconds(9));
        assertThat(log).hasSize(1);
    }

    private class Loops extends Actor {
        @Override
        protected void started() {
            // Schedule.FIXED_RATE: catches up on missed runs of the last second
            context().every(Duration.ofMillis(10), this::count);
            context()
                    .every(
                            Duration.ofMillis(10),
                            Schedule.SKIP_MISSED,
                            this::control); // drops missed runs: for control loops
            // one second after the end of the last run
            context().every("poll", Duration.ofSeconds(1), Schedule.FIXED_DELAY, this::poll);
        }

        private void count() {
            log.add("count");
        }

        private void control() {
            log.add("control");
        }

        private void poll() {
            log.add("poll");
        }
    }

    @Test
    void periodicTimer_thatIsLate_goesByItsSchedule() {
        test.spawn(Loops.class, Loops::new);
        test.clock().advance(Duration.ofMillis(1_500)); // in one step, as after a stall
        test.runQueued();
        assertThat(log).hasSize(150 + 1 + 1);
        assertThat(log).filteredOn("count"::equals).hasSize(150);
        test.advance(Duration.ofMillis(999));
        assertThat(log).filteredOn("poll"::equals).hasSize(1);
        test.advance(Duration.ofMillis(1));
        assertThat(log).filteredOn("poll"::equals).hasSize(2);
    }

    // ---- testing

    interface Pilot {
        Promise<Integer> look(int degrees);
    }

    private record LookingPilot(Camera camera) implements Pilot {
        @Override
        public Promise<Integer> look(int degrees) {
            camera.turn(degrees);
            return camera.shoot().thenApply(Image::blobs);
        }
    }

    @Test
    void probes_recordCalls_andAnswerOnDemand() {
        var image = new Image(4);
        Probe<Camera> camera = test.probe(Camera.class);
        Pilot pilot = test.spawn(Pilot.class, () -> new LookingPilot(camera.actor()));
        Promise<Integer> blobs = pilot.look(3);
        camera.expectCall("turn(3)"); // else an error that lists the calls so far; returns the arguments
        camera.expectCall("shoot()");
        camera.answer(image); // settles the oldest pending request; or reject(error)
        camera.expectNoCall();
        assertThat(test.get(blobs)).isEqualTo(4);
    }

    @Test
    void callbackProbe_recordsResultsAndTheEnd() {
        Robot robot = test.spawn(Robot.class, () -> colours -> {
            colours.next(255);
            colours.next(16711680);
            colours.finish();
        });
        CallbackProbe<Integer> colours = test.callback();
        robot.wander(colours);
        assertThat(colours.results()).containsExactly(255, 16711680);
        colours.expectFinished();
    }
}
