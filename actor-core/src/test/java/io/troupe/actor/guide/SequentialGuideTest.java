package io.troupe.actor.guide;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.Probe;
import io.troupe.actor.testkit.TestSpace;
import java.util.List;
import org.junit.jupiter.api.Test;

/** The section "Straight on: sequential and await". */
class SequentialGuideTest {
    record Image(int blobs) {}

    interface Camera {
        Promise<Image> shoot();
    }

    interface Robot {
        Promise<Boolean> goTo(String place);
    }

    static class Guard extends Actor {
        private final Robot robot;
        private final Camera camera;

        Guard(Robot robot, Camera camera) {
            this.robot = robot;
            this.camera = camera;
        }

        public Promise<Integer> patrol(List<String> places) {
            return space().sequential(() -> {
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
        try (var test = new TestSpace()) {
            Probe<Robot> robot = test.probe(Robot.class);
            Probe<Camera> camera = test.probe(Camera.class);
            Guard guard = test.spawn(Guard.class, () -> new Guard(robot.actor(), camera.actor()));
            Promise<Integer> blobs = guard.patrol(List.of("door", "window"));
            robot.expectCall("goTo(door)");
            assertThat(test.get(guard.name())).isEqualTo("guard");
            camera.expectNoCall();
            robot.answer(true);
            camera.answer(new Image(2));
            robot.expectCall("goTo(window)");
            robot.answer(true);
            camera.answer(new Image(5));
            assertThat(test.get(blobs)).isEqualTo(7);
        }
    }

    @Test
    void await_throwsWhatThePromiseWasRejectedWith() {
        try (var test = new TestSpace()) {
            Probe<Robot> robot = test.probe(Robot.class);
            Probe<Camera> camera = test.probe(Camera.class);
            Guard guard = test.spawn(Guard.class, () -> new Guard(robot.actor(), camera.actor()));
            Promise<Integer> blobs = guard.patrol(List.of("door"));
            robot.reject(new IllegalStateException("door is shut"));
            assertThat(test.error(blobs))
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessage("door is shut");
        }
    }
}
