package io.troupe.actor.guide;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Outcome;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.Probe;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** The section "Promises". */
class PromisesGuideTest {
    private static final Image DARK = new Image(0);
    private static final Image BRIGHT = new Image(2);

    private final TestSpace test = new TestSpace();
    private final List<Object> log = new ArrayList<>();

    record Image(int blobs) {}

    interface Camera {
        Promise<Image> shoot();
    }

    interface Finder {
        Promise<List<String>> blobs(Image image);
    }

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    private void steer(List<String> blobs) {
        log.add(blobs);
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
        assertThat(log).containsExactly(List.of("red", "blue"));
        shootFindAndSteer(camera.actor(), finder.actor());
        test.advance(Duration.ofSeconds(1));
        assertThat(log).containsExactly(List.of("red", "blue"), List.of());
        assertThat(camera.takeUnanswered()).hasSize(1);
    }

    /** The source of pictures. */
    static final class Driver {
        private final List<Consumer<Image>> listeners = new ArrayList<>();

        void onFrame(Consumer<Image> listener) {
            listeners.add(listener);
        }
    }

    static final class DrivenCamera implements Camera {
        private final Driver driver;

        DrivenCamera(Driver driver) {
            this.driver = driver;
        }

        @Override
        public Promise<Image> shoot() {
            var image = new Deferred<Image>();
            driver.onFrame(image::resolve); // from any thread; the first outcome counts
            return image;
        }
    }

    @Test
    void deferred_isSettledByTheFirstFrame() {
        var driver = new Driver();
        Camera camera = test.spawn(Camera.class, () -> new DrivenCamera(driver));
        Promise<Image> image = camera.shoot();
        test.crank();
        assertThat(image.isDone()).isFalse();
        driver.listeners.forEach(each -> each.accept(BRIGHT));
        driver.listeners.forEach(each -> each.accept(DARK));
        assertThat(test.get(image)).isEqualTo(BRIGHT);
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

        void remember(String name);
    }

    private static final class BusyGreeter implements Greeter {
        @Override
        public Promise<String> greet(String name) {
            return Promise.of("Hello, " + name);
        }

        @Override
        public void remember(String name) {}
    }

    @Test
    void timeout_namesCallerRequestAndProgress() {
        class Robot extends Actor {
            private final Greeter greeter;

            Robot(Greeter greeter) {
                this.greeter = greeter;
            }

            public void askWhenBusy() {
                for (int call = 0; call < 259; call++) { // timers run after 256 of them
                    greeter.remember("Ada");
                }
                greeter.greet("x").orTimeout(Duration.ofSeconds(1)).handle((text, error) -> note(error));
                test.clock().advance(Duration.ofSeconds(1));
            }

            private boolean note(@Nullable Throwable error) {
                return log.add(String.valueOf(error == null ? null : error.getMessage()));
            }
        }
        Greeter greeter = test.spawn(Greeter.class, BusyGreeter::new);
        Robot robot = test.spawn(Robot.class, () -> new Robot(greeter));
        robot.askWhenBusy();
        test.crank();
        assertThat(log)
                .containsExactly(
                        "no answer to Robot#2 within PT1S from Greeter.greet(x) of Greeter#1, which has not begun it: 3 calls come first");
    }
}
