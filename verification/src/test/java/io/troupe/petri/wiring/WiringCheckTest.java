package io.troupe.petri.wiring;

import static io.troupe.petri.Nets.refusals;
import static io.troupe.petri.Nets.refused;
import static io.troupe.petri.wiring.Protocol.acquires;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.releases;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.stops;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.SearchEnd;
import io.troupe.petri.wiring.WiringResult.Blocked;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.DeadlockFree;
import io.troupe.petri.wiring.WiringResult.Proved;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Wirings and their results, and declarations that are refused. */
class WiringCheckTest {
    private static Protocol client() {
        return Protocol.of("client")
                .state("idle", does("look").then("informed"))
                .state("informed", requests("planner.plan").then("planned"))
                .state(
                        "planned",
                        does("drive").then("idle"),
                        requests("planner.correct").then("idle"))
                .build();
    }

    private static Protocol planner() {
        return Protocol.of("planner")
                .state(
                        "ready",
                        provides("plan").then("ready"),
                        provides("correct").then("ready"))
                .build();
    }

    /** Takes a token when its neighbour passes one on, or passes one on itself. */
    private static final Protocol NEIGHBOUR = Protocol.of("neighbour")
            .state("idle", requests("next.take").then("idle"), provides("take").then("idle"))
            .build();

    private static Wiring ring(int size) {
        var ring = Wiring.of("ring").components("node", size, NEIGHBOUR);
        for (var i = 1; i <= size; i++) {
            ring.bind("node" + i, "next", "node" + (i % size + 1));
        }
        return ring.build();
    }

    private static WiringBuilder wiring(String name, Protocol... components) {
        var wiring = Wiring.of(name);
        List.of(components).forEach(wiring::component);
        return wiring;
    }

    @Test
    void components_neverDeadlock() {
        var wiring = Wiring.of("demo").component(client()).component(planner()).build();
        assertThat(WiringCheck.check(wiring)).isInstanceOf(Proved.class);
    }

    /** The samples in the Javadoc of {@link Protocol} and {@link Wiring}. */
    @Test
    void samplesOfTheJavadoc_areProved() {
        var client = Protocol.of("client")
                .state("idle", does("look").then("informed"))
                .state("informed", requests("planner.plan").then("idle"), stops())
                .build();
        var planner = Protocol.of("planner")
                .state("ready", provides("plan").then("ready"))
                .build();
        var wiring = Wiring.of("two clients")
                .components("client", 2, client)
                .component("planner", planner)
                .build();
        assertThat(WiringCheck.check(wiring)).isInstanceOf(Proved.class);
    }

    @Test
    void sixClients_ofOnePlanner_areProved() {
        var robots = Wiring.of("six").components("robot", 6, client()).component(planner());
        var result = WiringCheck.check(robots.build());
        assertThat(result).isInstanceOf(Proved.class);
        assertThat(result.figures().isComplete()).isTrue();
        assertThat(result.figures().neverReached()).isEmpty();
        assertThat(result.pairs()).hasSize(6).allMatch(PairResult::isFree);
        // Each robot is idle, informed, planned or waits for one of the two calls: 5^6 when the planner is ready;
        // while it serves one of them, before or after its step, with either call, the other five: 4 * 6 * 5^5.
        assertThat(result.figures().markings()).isEqualTo(15_625 + 4 * 6 * 3_125);
    }

    @Test
    void ringOfThree_deadlocksAlthoughAllPairsAreFree() {
        var result = (Deadlock) WiringCheck.check(ring(3));

        assertThat(result.pairs()).hasSize(3).allMatch(PairResult::isFree);
        assertThat(result.figures().deadMarkings()).isEqualTo(1);
        assertThat(result.counterexample().sentence())
                .isEqualTo("node1 waits for node2.take; node2 waits for node3.take; node3 waits for node1.take: all ask"
                        + " and none answers");
        assertThat(result.counterexample().firings())
                .containsExactlyInAnyOrder("node1 asks node2.take", "node2 asks node3.take", "node3 asks node1.take");
        assertThat(result.counterexample().circle())
                .containsExactly(
                        new Wait.Answer("node1", "node2", "take"),
                        new Wait.Answer("node2", "node3", "take"),
                        new Wait.Answer("node3", "node1", "take"));
        assertThat(result.repair()).isEmpty();
        refused(() -> WiringCheck.check(ring(3), 0), "maxMarkings is 0, expected 1 or more");
        assertThat(result.toString()).contains("can deadlock", "after 3 steps", "* node1 waits for node2.take");
        assertThatThrownBy(
                        () -> assertThat(result).as("an assertion that fails").isInstanceOf(Proved.class))
                .isInstanceOf(AssertionError.class)
                .hasMessageContaining("node3 waits for node1.take: all ask and none answers");
    }

    /** A server that takes two resources before it serves, and a user who may take a lock twice. */
    private static WiringBuilder nestedAcquisitions() {
        var server = Protocol.of("server")
                .state("s0", acquires("r1").then("s1"))
                .state("s1", acquires("r2").then("s2"))
                .state("s2", provides("go").then("s3"))
                .state("s3", releases("r2").then("s4"))
                .state("s4", releases("r1").then("s0"));
        var user = Protocol.of("user")
                .state("u", does("well").then("call"), does("badly").then("stuck"))
                .state("call", requests("server.go").then("u"))
                .state("stuck", acquires("lock").then("held"))
                .state("held", acquires("lock").then("twice"))
                .state("twice", releases("lock").then("held"));
        return wiring("nested", server.build(), user.build())
                .resource("r1", 1)
                .resource("r2", 1)
                .resource("lock", 1);
    }

    @Test
    void nestedAcquisitions_deadlockWithinAnyLimit() {
        for (var limit : List.of(1, 5, 20, 100_000)) {
            var result = (Deadlock) WiringCheck.check(nestedAcquisitions().build(), limit);
            assertThat(result.counterexample().waits())
                    .extracting(Wait::component)
                    .containsExactlyInAnyOrder("server", "user");
        }
    }

    private static Wiring philosophers(int count) {
        return philosophers(count, false);
    }

    /** With {@code leftHanded} the last philosopher takes the forks in the other order. */
    private static Wiring philosophers(int count, boolean leftHanded) {
        var fork = Protocol.of("fork")
                .state("free", provides("take").then("taken"))
                .state("taken", provides("put").then("free"))
                .build();
        var philosopher = Protocol.of("phil")
                .state("thinking", requests("left.take").then("has left"))
                .state("has left", requests("right.take").then("eating"))
                .state("eating", requests("left.put").then("has right"))
                .state("has right", requests("right.put").then("thinking"))
                .build();
        var table = Wiring.of("table").components("phil", count, philosopher).components("fork", count, fork);
        for (var i = 1; i <= count; i++) {
            var isOther = leftHanded && i == count;
            table.bind("phil" + i, isOther ? "right" : "left", "fork" + i);
            table.bind("phil" + i, isOther ? "left" : "right", "fork" + (i % count + 1));
        }
        return table.build();
    }

    /**
     * Each philosopher holds the left fork. By protocol, fork 2 may be put down by its neighbours 1 and 2, but only 2
     * holds it.
     */
    @Test
    void philosophers_counterexampleNamesWhoHoldsWhichForkAndStarsTheWholeCircle() {
        var counterexample = ((Deadlock) WiringCheck.check(philosophers(3))).counterexample();
        assertThat(counterexample.waits())
                .contains(
                        new Wait.Call("fork1", "taken", List.of(new Wait.Offer("put", List.of("phil1")))),
                        new Wait.Call("fork2", "taken", List.of(new Wait.Offer("put", List.of("phil2")))),
                        new Wait.Call("fork3", "taken", List.of(new Wait.Offer("put", List.of("phil3")))));
        assertThat(counterexample.circle())
                .extracting(Wait::component)
                .containsExactlyInAnyOrder("phil1", "fork2", "phil2", "fork3", "phil3", "fork1");
        assertThat(counterexample.toString()).contains("* fork2 (taken) waits to be called: put by phil2");
    }

    /** 12 philosophers have more markings than a search of them all may visit. */
    @Test
    void manyPhilosophers_deadlock_andOneLeftHandedPreventsIt() {
        var dead = (Deadlock) WiringCheck.check(philosophers(30));
        assertThat(dead.counterexample().firings()).hasSize(5 * 30);
        assertThat(dead.counterexample().isShortest()).isFalse();
        assertThat(dead.counterexample().circle()).hasSize(2 * 30);
        assertThat(dead.reduced()).hasToString("151 markings by a hunt (stopped at this limit), 1 dead so far");
        var free = (DeadlockFree) WiringCheck.check(philosophers(30, true), 2000);
        assertThat(free.reduced()).hasToString("0 markings by reductions, 0 dead and no others");
    }

    @Test
    void stop_leavesOneBlockedWhileAnotherGoesOn() {
        var server = Protocol.of("server")
                .state("off", provides("open").then("on"))
                .state("on", provides("use").then("on"), stops());
        var user = Protocol.of("user")
                .state("start", requests("server.open").then("using"))
                .state("using", requests("server.use").then("using"));
        var clock = Protocol.of("clock").state("ticking", does("tick").then("ticking"));
        var result = (Blocked) WiringCheck.check(
                wiring("blocked", server.build(), user.build(), clock.build()).build());
        assertThat(result.figures().deadMarkings()).isZero();
        assertThat(result.counterexample().sentence())
                .isEqualTo("server stops; user waits for server.use, which no component will answer");
        assertThat(result.counterexample().waits()).extracting(Wait::component).containsExactly("server", "user");
        assertThat(result.pairs()).extracting(PairResult::isFree).containsExactly(false);
    }

    /** The server has a private step left, so it is no part of the story. */
    @Test
    void singleWait_saysThatNobodyWillAnswer() {
        var server = Protocol.of("server")
                .state("busy", does("end").then("rest"), provides("cancel").then("rest"))
                .state("rest", does("rest").then("rest"));
        var client = Protocol.of("client").state("on", requests("server.cancel").then("off"));
        client.state("off", does("wait").then("off"));
        var result = (Blocked) WiringCheck.check(
                wiring("cancel", server.build(), client.build()).build());
        assertThat(result.counterexample().sentence())
                .isEqualTo("client waits for server.cancel, which no component will answer");
    }

    @Test
    void repair_thatDoesNotHelp_isNotCalledProved() {
        var stopping = Protocol.of("node")
                .state("off", does("start").then("idle"))
                .state(
                        "idle",
                        requests("next.take").then("idle"),
                        provides("take").then("idle"),
                        stops())
                .build();
        var wiring = Wiring.of("pair")
                .components("node", 2, stopping)
                .bind("node1", "next", "node2")
                .bind("node2", "next", "node1")
                .build();
        var repair = ((Deadlock) WiringCheck.check(wiring)).repair().orElseThrow();
        assertThat(repair.isProved()).isFalse();
        assertThat(repair.toString()).contains("not proved");
        assertThat(((Deadlock) repair.result()).repair()).isEmpty();
    }

    @Test
    void synchronisedStop_inSeveralStates_isTakenInEveryCombination() {
        var lamp = Protocol.of("lamp")
                .state("off", does("start").then("dark"))
                .state("dark", provides("light").then("bright"), stops())
                .state("bright", provides("dim").then("dark"), stops());
        var user = Protocol.of("user")
                .state("away", does("come").then("wants light"))
                .state("wants light", requests("lamp.light").then("wants dark"))
                .state("wants dark", requests("lamp.dim").then("thinks"))
                .state(
                        "thinks",
                        does("go on").then("wants light"),
                        does("leave").then("leaving"))
                .state("leaving", stops());
        var together = wiring("lamp", lamp.build(), user.build()).build().withSynchronisedStop();
        assertThat(together.net().transitions())
                .extracting(Object::toString)
                .contains("all stop: {lamp=dark, user=leaving}", "all stop: {lamp=bright, user=leaving}")
                .noneMatch(name -> name.contains("#"));
        assertThat(WiringCheck.check(together)).isInstanceOf(Proved.class);
    }

    @Test
    void openCall_isMadeFromOutside() {
        var wiring = Wiring.of("open").component(planner()).open("planner.plan").open("planner.correct");
        var result = WiringCheck.check(wiring.build());
        assertThat(result).isInstanceOf(Proved.class);
        assertThat(result.figures()).isEqualTo(new Figures(1, 2, 4, 1, 2, 0, SearchEnd.COMPLETE, List.of()));
    }

    @Test
    void stateOfAWiring_thatNobodyReaches_isInTheFigures() {
        var server = Protocol.of("server")
                .state("first", provides("first").then("second"))
                .state("second", provides("second").then("first"));
        var wrong = Protocol.of("wrong")
                .state("start", requests("server.second").then("then"))
                .state("then", requests("server.first").then("start"));
        var result = (Deadlock)
                WiringCheck.check(wiring("order", wrong.build(), server.build()).build());
        assertThat(result.figures().neverReached()).contains("server.second", "wrong.then");
        assertThat(result.counterexample().sentence())
                .isEqualTo(
                        "wrong waits for server.second, which no component will answer; server (first) waits to be called:"
                                + " first by wrong, which no component will do");
    }

    // ---- declarations that are refused

    private static final Protocol PLAYER = Protocol.of("player")
            .state("ready", provides("setValues").then("ready"))
            .build();

    private static Protocol asking(String target) {
        return Protocol.of("robot").state("idle", requests(target).then("idle")).build();
    }

    private static WiringBuilder w(Protocol... components) {
        return wiring("w", components);
    }

    private static ProtocolBuilder p(String state, Branch... branches) {
        return Protocol.of("p").state(state, branches);
    }

    @Test
    void wirings_thatMakeNoSense_areRefused() {
        var bound = w(asking("player.setValues")).component("player1", PLAYER).bind("robot", "player", "player2");
        assertThat(refusals(
                        w(asking("plaier.setValues"), PLAYER)::build,
                        w(asking("player.setValue"), PLAYER)::build,
                        w(asking("robot2.move")).component("robot2", asking("robot.move"))::build,
                        w(asking("robot.move"))::build,
                        w(PLAYER)::build,
                        w(PLAYER).open("player.setValue")::build,
                        w(PLAYER, asking("player.setValues")).open("player.setValues")::build,
                        () -> w().component("a.b", PLAYER),
                        () -> w(PLAYER, PLAYER),
                        w()::build,
                        () -> w().components("p", 0, PLAYER),
                        bound::build,
                        () -> bound.bind("robot", "player", "player1"),
                        w(PLAYER).bind("player", "robot", "player")::build,
                        w(PLAYER).bind("playr", "robot", "player")::build))
                .isEqualTo("""
                wiring w: robot requests plaier.setValues in state idle, but there is no component plaier; did you \
                mean player? known: robot, player
                wiring w: robot requests player.setValue in state idle, but player never offers setValue; did you \
                mean setValues? known: setValues
                wiring w: robot requests robot2.move in state idle, but robot2 never offers move; there are none
                wiring w: robot requests robot.move in state idle of itself; expected another component
                wiring w: player offers setValues, but no component requests it; request it, or declare player.setValues open
                wiring w: open call player.setValue is not offered; did you mean player.setValues? known: \
                player.setValues
                wiring w: player.setValues is declared open and requested by [robot]; expected one of the two
                wiring w: the name of a component is "a.b", expected letters, digits, - and _ without spaces or dots
                wiring w: there are two components called player
                wiring w: there are no components; expected 1 or more
                wiring w: there are 0 components p, expected 1 or more
                wiring w: robot.player is bound to the unknown component player2; did you mean player1? known: robot, \
                player1
                wiring w: robot.player is bound twice, to player2 and to player1
                wiring w: player.robot is bound, but player requests nothing of robot; there are none
                wiring w: playr.robot is bound, but there is no component playr; did you mean player? known: player""");
    }

    @Test
    void protocols_thatMakeNoSense_areRefused() {
        var loop = does("x").then("a");
        assertThat(refusals(
                        p("a", loop).state("b", does("y").then("a"))::build,
                        p("driving", does("x").then("drivng"))::build,
                        Protocol.of("p")::build,
                        () -> p("a"),
                        () -> p("a", loop).state("a", does("y").then("a")),
                        () -> p("a", loop, loop),
                        () -> p("a", stops()),
                        () -> p(" a", stops()),
                        () -> asking("setValues"),
                        () -> asking("player.set values")))
                .isEqualTo("""
                protocol p: state b cannot be reached from the first state a; expected a step that leads to it
                protocol p: a step of state driving leads to state drivng, which is not declared; did you mean \
                driving? known: driving
                protocol p: there are no states; expected 1 or more
                protocol p: nothing leads out of state a; expected a step, a stop or ends()
                protocol p: state a is declared twice
                protocol p: state a does x twice; expected different names for a choice
                protocol p: state a is the first one and stops; expected a stop in a later state
                protocol p: a state is called " a", expected text without control characters or space around it
                protocol robot: state idle requests setValues, expected component.call
                protocol robot: the call of request player.set values is "set values", expected letters, digits, - \
                and _ without spaces or dots""");
    }
}
