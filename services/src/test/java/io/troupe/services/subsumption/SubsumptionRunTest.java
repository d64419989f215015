package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.actor.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Failures of the robot services in callback mode, where a call has no promise that could be rejected. */
@Timeout(60)
class SubsumptionRunTest {
    /** Takes calls and never reports anything. */
    private static class Silent extends Actor implements RobotServices {
        @Override
        public Promise<ServiceEnd> drive(int robot, String service, int stateColour) {
            throw new UnsupportedOperationException();
        }

        @Override
        public void drive(int robot, String service, Callback<ColourReport> reports) {}

        @Override
        public Promise<@Nullable Void> stop(int robot) {
            return Promise.done();
        }
    }

    private static void run(Supplier<? extends RobotServices> provider) throws InterruptedException {
        var settings = new SubsumptionRun.Settings(
                Mode.CALLBACK,
                "localhost",
                FakeRobots.PORT,
                SubsumptionTable.ofThePaper(),
                Clock.system(),
                ServiceObserver.NONE,
                (state, seenBy) -> {});
        try (var run = SubsumptionRun.start(settings, provider)) {
            run.check();
        }
    }

    @Test
    void servicesThatAnswerNothing_areNoFailure() throws InterruptedException {
        run(Silent::new);
    }

    @Test
    void callThatReachesNoServices_isAFailure() {
        try (var test = new TestSpace()) {
            var failures = new ArrayList<Throwable>();
            RobotServices services = SubsumptionRun.publishAndConnect(
                    test.space(),
                    () -> {
                        throw new IllegalStateException("no robots");
                    },
                    failures::add);
            test.run(() -> services.drive(0, "wallFollower", (report, error) -> {}));
            failures.clear(); // of the start
            test.advance(Duration.ofSeconds(2));
            assertThat(failures).singleElement().asString().contains("drive", "found no provider");
            assertThat(test.takeProblems()).hasSize(1); // of the start
        }
    }

    @Test
    void servicesThatEnd_areAFailureOfTheRun() {
        assertThatThrownBy(() -> run(() -> new Silent() {
                    @Override
                    public void drive(int robot, String service, Callback<ColourReport> reports) {
                        if (robot == 1) { // the last call
                            stop();
                        }
                    }
                }))
                .hasMessageContaining("robotServices");
    }

    @Test
    void servicesThatCannotStart_areAFailureOfTheRun() {
        assertThatThrownBy(() -> run(() -> {
                    throw new IllegalStateException("no robots");
                }))
                .hasStackTraceContaining("no robots");
    }
}
