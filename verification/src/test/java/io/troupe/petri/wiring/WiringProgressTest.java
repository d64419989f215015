package io.troupe.petri.wiring;

import static io.troupe.petri.Nets.refused;
import static io.troupe.petri.wiring.Protocol.accepts;
import static io.troupe.petri.wiring.Protocol.answered;
import static io.troupe.petri.wiring.Protocol.answers;
import static io.troupe.petri.wiring.Protocol.asks;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.ends;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.refuses;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.WiringProgress.Fails;
import io.troupe.petri.wiring.WiringProgress.Holds;
import io.troupe.petri.wiring.WiringProgress.Unknown;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.junit.jupiter.api.Test;

/** Questions about what components get in the end. */
class WiringProgressTest {
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
        assertThat(progress.everyRequestIsAnswered()).isInstanceOf(Holds.class);
        assertThat(progress.alwaysAgain("robot", "driven")).isInstanceOf(Holds.class);

        var fails = (Fails) WiringProgress.of(drivers(true)).alwaysAgain("robot", "driven");
        assertThat(fails).hasToString("""
                robot is never driven again
                  after 1 steps:
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
        var fails = (Fails) WiringProgress.of(wiring).everyRequestIsAnswered();
        assertThat(fails.sentence()).isEqualTo("client waits for planner.plan and is never answered");
        assertThat(fails.firings())
                .containsExactlyInAnyOrder("client asks planner.plan and goes on", "planner: begin to map");
        assertThat(fails.forever().orElseThrow()).containsExactlyInAnyOrder("client: look around", "planner: map");
    }

    /** Two connections for three clients; a lease that expires gives one back while its client goes on to use it. */
    private static Wiring pool(boolean expires) {
        var pool = Protocol.of("pool");
        for (var free = 2; free >= 0; free--) {
            var ways = new ArrayList<Branch>();
            if (free > 0) {
                ways.add(provides("take").then("free " + (free - 1)));
            }
            if (free < 2) {
                ways.add(provides("give").then("free " + (free + 1)));
                if (expires) {
                    ways.add(does("a lease expires").then("free " + (free + 1)));
                }
            } else if (expires) {
                ways.add(provides("give").then("free 2")); // too late
            }
            pool.state("free " + free, ways.toArray(new Branch[0]));
        }
        var client = Protocol.of("client")
                .state("idle", requests("pool.take").then("using"))
                .state("using", does("use").then("done"))
                .state("done", requests("pool.give").then("idle"))
                .build();
        return Wiring.of("pool")
                .components("client", 3, client)
                .component(pool.build())
                .build();
    }

    private static final Map<String, Set<String>> ALL_USE =
            Map.of("client1", Set.of("using"), "client2", Set.of("using"), "client3", Set.of("using"));

    @Test
    void connections_areNeverUsedByMoreThanThereAre_unlessALeaseExpires() {
        assertThat(WiringCheck.check(pool(true))).isInstanceOf(WiringResult.Proved.class);
        assertThat(WiringProgress.of(pool(false)).never(ALL_USE)).isEqualTo(new Holds(List.of()));
        var fails = (Fails) WiringProgress.of(pool(true)).never(ALL_USE);
        assertThat(fails.sentence()).isEqualTo("client1 is using, client2 is using, client3 is using");
        assertThat(fails.firings()).hasSize(13).contains("pool: a lease expires (in free 1)");
        assertThat(fails.toString())
                .startsWith("client1 is using, client2 is using, client3 is using\n  after 13 steps:\n    1. ")
                .doesNotContain("then");
    }

    /** Each of two participants votes, and the coordinator commits if both agree; one may give up by itself. */
    private static Wiring commit(boolean alone) {
        var coordinator = Protocol.of("coordinator")
                .state("new", requests("p1.prepare").then("first").orRejected("aborting 2"))
                .state("first", requests("p2.prepare").then("committing 1").orRejected("aborting 1"))
                .state("committing 1", requests("p1.commit").then("committing 2"))
                .state("committing 2", requests("p2.commit").then("over"))
                .state("aborting 1", requests("p1.abort").then("over"))
                .state("aborting 2", requests("p2.abort").then("over"))
                .state("over", ends())
                .build();
        var ways = new ArrayList<>(
                List.of(provides("commit").then("committed"), provides("abort").then("aborted")));
        if (alone) {
            ways.add(does("time out").then("gave up"));
        }
        var participant = Protocol.of("participant")
                .state(
                        "new",
                        accepts("prepare").then("asked"),
                        provides("abort").then("aborted"))
                .state(
                        "asked",
                        answers("prepare").then("prepared"),
                        refuses("prepare").then("aborted"))
                .state("prepared", ways.toArray(new Branch[0]))
                .state("committed", ends())
                .state("aborted", ends());
        if (alone) {
            participant.state(
                    "gave up",
                    provides("commit").then("aborted"),
                    provides("abort").then("aborted"));
        }
        return Wiring.of("commit")
                .component(coordinator)
                .components("p", 2, participant.build())
                .build();
    }

    @Test
    void participants_neverDisagree_unlessOneGivesUpAlone() {
        for (var alone : new boolean[] {false, true}) {
            var wiring = commit(alone);
            assertThat(WiringCheck.check(wiring)).isInstanceOf(WiringResult.Proved.class);
            var progress = WiringProgress.of(wiring);
            var disagree = progress.never(Map.of("p1", Set.of("committed"), "p2", Set.of("aborted")));
            assertThat(disagree).isInstanceOf(alone ? Fails.class : Holds.class);
            var both = (Holds) progress.canReach(Map.of("p1", Set.of("committed"), "p2", Set.of("committed")));
            assertThat(both.firings()).last().asString().startsWith("p2 answers commit");
            assertThat(progress.alwaysAgain("coordinator", "over")).isInstanceOf(Holds.class);
        }
        assertThat(WiringProgress.of(commit(false))
                        .canReach(Map.of("p1", Set.of("committed"), "p2", Set.of("aborted"))))
                .hasToString("never at once: p1 is committed, p2 is aborted");
    }

    @Test
    void samples() {
        var commit = commit(false);
        var progress = WiringProgress.of(commit);
        assertThat(progress.never(Map.of("p1", Set.of("committed"), "p2", Set.of("aborted"))))
                .isInstanceOf(Holds.class);
        assertThat(progress.canReach(Map.of("p1", Set.of("committed")))).isInstanceOf(Holds.class);
        assertThat(progress.everyRequestIsAnswered()).isInstanceOf(Holds.class);
        assertThat(progress.alwaysAgain("coordinator", "over")).isInstanceOf(Holds.class);
    }

    /** A component that waits for the answer, or waits for a resource, is still in its state. */
    @Test
    void component_isInAStateUntilItsStepIsOver() {
        var progress = WiringProgress.of(drivers(false));
        var holds = (Holds) progress.canReach(Map.of("driver", Set.of("on"), "robot", Set.of("driven")));
        assertThat(holds.firings()).hasSize(4);
        assertThat(progress.never(Map.of("driver", Set.of("on"), "robot", Set.of("idle"))))
                .isInstanceOf(Holds.class);
        var tools = WiringProgress.of(DeclarationsTest.tools(false).build());
        assertThat(tools.never(Map.of("worker1", Set.of("two"), "worker2", Set.of("one", "two"))))
                .isInstanceOf(Holds.class);
        assertThat(tools.canReach(Map.of("worker1", Set.of("one"), "worker2", Set.of("one"))))
                .isInstanceOf(Holds.class);
        refused(
                () -> progress.never(Map.of()),
                "wiring drivers: a question is about no component; expected one or more with their states");
    }

    @Test
    void wiring_thatIsTooLarge_isNotDecided() {
        var progress = WiringProgress.of(drivers(false), SearchLimits.markings(2));
        assertThat(progress.alwaysAgain("robot", "driven")).isEqualTo(new Unknown(SearchEnd.LIMIT, 2));
        refused(
                () -> progress.alwaysAgain("robot", "drivn"),
                "wiring drivers: robot has no state drivn; did you mean driven? known: idle, driven");
    }
}
