package io.troupe.actor.guide;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Topic;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.Probe;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** The sections "Many results: callbacks", "Many readers: topics", and the probes of "Testing". */
class CallbacksGuideTest {
    private final TestSpace test = new TestSpace();
    private final List<Object> log = new ArrayList<>();

    interface Robot {
        void wander(Callback<Integer> colours);
    }

    private static final class ColourBlindRobot implements Robot {
        @Override
        public void wander(Callback<Integer> colours) {
            for (int colour : new int[] {255, 16711680}) {
                colours.next(colour);
            }
            colours.finish();
        }
    }

    /** Stores its callbacks. */
    private static final class SlowRobot implements Robot {
        private final List<Callback<Integer>> readers = new ArrayList<>();

        @Override
        public void wander(Callback<Integer> colours) {
            readers.add(colours);
        }
    }

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    private void show(@Nullable Object what) {
        log.add(String.valueOf(what));
    }

    private void done() {
        log.add("done");
    }

    @Test
    void callbacks_bringEveryResult_untilTheyAreCancelled() {
        var slow = new SlowRobot();
        Robot robot = test.spawn(Robot.class, () -> slow);
        robot.wander((colour, error) -> show(colour)); // as the paper writes it
        var stream = new Callback.Stream<Integer>(this::show, end -> done()); // notified of the end; can be cancelled
        robot.wander(stream);
        stream.cancel(); // the robot sees colours.isCancelled()
        test.crank();
        assertThat(slow.readers).extracting(Callback::isCancelled).containsExactly(false, true);
        slow.readers.forEach(colours -> colours.next(255));
        slow.readers.getFirst().next(16711680);
        test.crank();
        assertThat(log).containsExactly("done", "255", "16711680");
    }

    record Scan(double nearestMetres) {}

    private void avoid(Scan scan) {
        log.add(scan);
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
        test.crank();
        assertThat(log).containsExactly(scan);
        assertThat(scans.publish(new Scan(0.3))).isEqualTo(1);
        scans.finish();
        test.crank();
        assertThat(log).containsExactly(scan, new Scan(0.3), "done");
    }

    record Image(int blobs) {}

    interface Camera {
        void turn(int degrees);

        Promise<Image> shoot();
    }

    interface Pilot {
        Promise<Integer> look(int degrees);
    }

    @Test
    void probes_recordCalls_andAnswerOnDemand() {
        record LookingPilot(Camera camera) implements Pilot {
            @Override
            public Promise<Integer> look(int degrees) {
                camera.turn(degrees);
                return camera.shoot().thenApply(Image::blobs);
            }
        }
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
        Robot robot = test.spawn(Robot.class, ColourBlindRobot::new);
        CallbackProbe<Integer> colours = test.callback();
        robot.wander(colours);
        assertThat(colours.results()).containsExactly(255, 16711680);
        colours.expectFinished();
    }
}
