package io.troupe.petri.wiring;

import static io.troupe.petri.Nets.refused;
import static io.troupe.petri.wiring.Protocol.answered;
import static io.troupe.petri.wiring.Protocol.asks;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Answer;
import io.troupe.petri.Answer.No;
import io.troupe.petri.Answer.Unknown;
import io.troupe.petri.Answer.Yes;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.WiringProgress.Fails;
import java.util.Map;
import java.util.Set;
import org.junit.jupiter.api.Test;

/** Questions about what components get in the end. */
class WiringProgressTest {
    private static Fails counterexample(Answer<Fails> answer) {
        return ((No<Fails>) answer).counterexample();
    }

    private static Wiring drivers(boolean retires) {
        var robot = Protocol.of("robot")
                .state("idle", provides("drive").then("driven"))
                .state("driven", provides("leave").then("idle"))
                .build();
        var driver = Protocol.of("driver");
        if (retires) {
            driver.state(
                            "off",
                            requests("robot.drive").then("on"),
                            does("retire").then("retired"))
                    .state("retired", does("rest").then("retired"));
        } else {
            driver.state("off", requests("robot.drive").then("on"));
        }
        driver.state("on", requests("robot.leave").then("off"));
        return Wiring.of("drivers").component(robot).component(driver.build()).build();
    }

    @Test
    void robot_alwaysGetsADriverAgain_unlessTheDriverMayRetire() {
        var wiring = drivers(false);
        var progress = WiringProgress.of(wiring);
        assertThat(progress.everyRequestIsAnswered()).isInstanceOf(Yes.class);
        assertThat(progress.alwaysAgain("robot", "driven")).isInstanceOf(Yes.class);

        var fails = counterexample(WiringProgress.of(drivers(true)).alwaysAgain("robot", "driven"));
        assertThat(fails).hasToString("""
                robot is never driven again
                  after 1 step:
                    1. driver: retire
                  then for ever only:
                    driver: rest""");
    }

    /** All components can go on, but the planner may turn to other work before it takes the question. */
    @Test
    void question_thatIsNeverTaken_isNamed() {
        var client = Protocol.of("client")
                .state("idle", asks("planner.plan").then("waiting"))
                .state(
                        "waiting",
                        answered("planner.plan").then("idle"),
                        does("look around").then("waiting"));
        var planner = Protocol.of("planner")
                .state(
                        "ready",
                        provides("plan").then("ready"),
                        does("begin to map").then("mapping"))
                .state("mapping", does("map").then("mapping"));
        var wiring = Wiring.of("plans")
                .component(client.build())
                .component(planner.build())
                .build();
        assertThat(WiringCheck.check(wiring)).isInstanceOf(WiringResult.Proved.class);
        var fails = counterexample(WiringProgress.of(wiring).everyRequestIsAnswered());
        assertThat(fails.sentence()).isEqualTo("client waits for planner.plan and is never answered");
        assertThat(fails.firings())
                .containsExactlyInAnyOrder("client asks planner.plan and goes on", "planner: begin to map");
        assertThat(fails.forever().orElseThrow()).containsExactlyInAnyOrder("client: look around", "planner: map");
    }

    /** A component that waits for the answer, or waits for a resource, is still in its state. */
    @Test
    void component_isInAStateUntilItsStepIsOver() {
        var progress = WiringProgress.of(drivers(false));
        var driving = Map.of("driver", Set.of("on"), "robot", Set.of("driven"));
        assertThat(counterexample(progress.never(driving)).firings()).hasSize(4);
        assertThat(progress.canReach(driving)).isInstanceOf(Yes.class);
        assertThat(progress.never(Map.of("driver", Set.of("on"), "robot", Set.of("idle"))))
                .isInstanceOf(Yes.class);
        var tools = WiringProgress.of(DeclarationsTest.tools(false).build());
        assertThat(tools.never(Map.of("worker1", Set.of("two"), "worker2", Set.of("one", "two"))))
                .isInstanceOf(Yes.class);
        assertThat(tools.canReach(Map.of("worker1", Set.of("one"), "worker2", Set.of("one"))))
                .isInstanceOf(Yes.class);
        refused(
                () -> progress.never(Map.of()),
                "wiring drivers: a question is about no component; expected one or more with their states");
    }

    @Test
    void wiring_thatIsTooLarge_isNotDecided() {
        var progress = WiringProgress.of(drivers(false), SearchLimits.markings(2));
        assertThat(progress.alwaysAgain("robot", "driven")).isEqualTo(new Unknown<>(SearchEnd.LIMIT, 2));
        refused(
                () -> progress.alwaysAgain("robot", "drivn"),
                "wiring drivers: robot has no state drivn; did you mean driven? known: idle, driven");
    }
}
