package io.troupe.petri.wiring;

import static io.troupe.petri.Nets.refused;
import static io.troupe.petri.wiring.Protocol.does;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.tuple;

import io.troupe.petri.Marking;
import io.troupe.petri.Meld;
import io.troupe.petri.Nets;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.RobotTeams;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.WiringResult.Blocked;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.DeadlockFree;
import io.troupe.petri.wiring.WiringResult.Proved;
import io.troupe.petri.wiring.WiringResult.Unknown;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * The paper's four components as declarations give the paper's nets, and its claims; also for several robots with a
 * player each, which share one middleware and one service.
 */
class PaperWiringTest {
    private static final SearchLimits SMALL = SearchLimits.markings(100_000);
    private static final String SERVICE_WAITS =
            "middleware stops; service (ready) waits to be called: receive by middleware, which no component will do";
    private static final String ROBOT_WAITS =
            "player stops; robot waits for player.setValues, which no component will answer";
    private static final String BOTH_ASK =
            "middleware waits for service.receive; service waits for middleware.register: all ask and none answers";

    private static Deadlock deadlock(Wiring wiring) {
        return (Deadlock) WiringCheck.check(wiring);
    }

    private static Figures figures(int places, int transitions, int arcs, int markings, int edges, int dead) {
        return new Figures(places, transitions, arcs, markings, edges, dead, SearchEnd.COMPLETE, List.of());
    }

    private static List<String> sentences(PairResult pair) {
        return pair.counterexamples().stream().map(Counterexample::sentence).toList();
    }

    /** The marking in which a counterexample ends. */
    private static Marking end(PetriNet net, Counterexample counterexample) {
        var sequence = counterexample.firings().stream().map(net::transition).toList();
        return net.fire(net.initialMarking(), sequence);
    }

    /** The paper's names of places and transitions by those that the declarations give. */
    private static Map<String, String> paperNames() {
        var names = new HashMap<String, String>();
        var pairs = """
                robot.off=R1, robot.started=R2, robot.driving=R5, robot.sensed=R6, robot.set=R9, robot.leaving=R10,
                robot: start=Tr1, robot: read sensors=Tr3, robot: go on=Tr5, robot: decide to stop=Tr6, robot stops=Tr7,
                player.idle=P1, player.ready=P4, player.loaded=P7, player stops=Tp4,
                middleware.idle=M1, middleware.ready=M4, middleware.loaded=M7, middleware stops=Tm4,
                service.idle=S1, service.registered=S4, service.ready=S10, service.decides=S7, service.following=S8,
                service.wandering=S9, service: get ready=Ts8, service: choose wall follower=Ts3,
                service: choose wanderer=Ts4, service: follow the wall=Ts5, service: wander=Ts6, service stops=Ts7,
                all stop=Tstop, robot and player stop=Tstop""";
        for (var pair : pairs.split(",\\s+")) {
            names.put(pair.split("=")[0], pair.split("=")[1]);
        }
        addCall(names, "robot", "player", "getProxies", PaperNets.getProxies());
        addCall(names, "robot", "player", "setValues", PaperNets.setValues());
        addCall(names, "player", "middleware", "receive", PaperNets.transmit());
        addCall(names, "service", "middleware", "register", PaperNets.register());
        addCall(names, "middleware", "service", "receive", PaperNets.giveData());
        return names;
    }

    private static void addCall(Map<String, String> names, String caller, String provider, String call, Meld meld) {
        names.put(caller + " requests " + provider + "." + call, meld.request());
        names.put(caller + " asks " + provider + "." + call, meld.asking());
        names.put(caller + " waits for " + provider + "." + call, meld.waiting());
        names.put(provider + " takes " + call + " from " + caller, meld.accept());
        names.put(caller + " is served " + provider + "." + call, meld.pending());
        names.put(provider + " has taken " + call, meld.before());
        names.put(provider + " does " + call, meld.offer());
        names.put(provider + " has done " + call, meld.after());
        names.put(provider + " answers " + call + " to " + caller, meld.answer());
    }

    /** In the teams, the names of the parts of robot 1 and its player end in .1. */
    private static void requireSame(PetriNet derived, PetriNet paper) {
        var names = paperNames();
        var renamed = derived.renamed(paper.name(), name -> {
            var number = Pattern.compile("\\d").matcher(name);
            return names.get(name.replaceAll("\\d", "")) + (number.find() ? "." + number.group() : "");
        });
        assertThat(renamed.sameStructureAs(paper)).as(paper.name()).isTrue();
    }

    @Test
    void nets_ofTheDeclarations_areThePapersUpToNames() {
        var wiring = PaperWiring.wiring();
        requireSame(wiring.net(), PaperNets.uncorrected(Reading.A));
        requireSame(wiring.withSynchronisedStop().net(), PaperNets.corrected(Reading.A));
        var pair = new WiringNet(wiring, Set.of("robot", "player"));
        requireSame(pair.net(), Nets.part("robot player", "Tr2 Tr4"));
        var team = PaperWiring.robots(2);
        requireSame(team.net(), RobotTeams.uncorrected(2));
        requireSame(team.withSynchronisedStop().net(), RobotTeams.stoppingTogether(2));
        requireSame(PaperWiring.robotsStoppingOneByOne(2).net(), RobotTeams.stoppingOneByOne(2));
    }

    /** Shows that the comparison of the test above can fail. */
    @Test
    void nets_thatDiffer_areNotTheSame() {
        var net = PaperWiring.wiring().net();
        var paper = PaperNets.uncorrected(Reading.A);
        var arcTurned = paper.toBuilder()
                .remove("Tr7")
                .transition("Tr7", List.of("R10"), List.of("R2"))
                .build();
        var statesSwapped = paper.renamed("states swapped", name -> switch (name) {
            case "P1" -> "P4";
            case "P4" -> "P1";
            default -> name;
        });
        for (var other :
                List.of(PaperNets.uncorrected(Reading.B), PaperNets.corrected(Reading.A), arcTurned, statesSwapped)) {
            assertThatThrownBy(() -> requireSame(net, other))
                    .isInstanceOf(AssertionError.class)
                    .hasMessageContaining(other.name());
        }
    }

    @Test
    void check_ofTheDeclarations_findsSixDeadMarkingsAndTheShortestCounterexample() {
        var wiring = PaperWiring.wiring();
        var result = deadlock(wiring);

        assertThat(result.figures()).isEqualTo(figures(38, 33, 86, 1264, 3706, 6));
        assertThat(result.counterexamples())
                .allSatisfy(each -> assertThat(wiring.net().enabled(end(wiring.net(), each)))
                        .isEmpty())
                .extracting(counterexample -> counterexample.firings().size())
                .containsExactly(14, 20, 21, 25, 31, 32);
        var counterexample = result.counterexample();
        assertThat(counterexample.sentence()).isEqualTo(ROBOT_WAITS);
        assertThat(counterexample.firings())
                .startsWith("robot: start", "robot asks player.getProxies", "player takes getProxies from robot")
                .contains("player stops", "robot asks player.setValues", "middleware stops", "service: get ready");
        assertThat(counterexample.circle())
                .containsExactly(
                        new Wait.Answer("robot", "player", "setValues"),
                        new Wait.Call("player", "idle", List.of(new Wait.Offer("getProxies", List.of("robot")))));
        assertThat(counterexample.waits())
                .extracting(Wait::component)
                .containsExactly("robot", "player", "middleware", "service");
    }

    @Test
    void causes_areTheNearestBlocksForEver() {
        var causes = deadlock(PaperWiring.wiring()).causes();
        assertThat(causes).extracting(cause -> cause.firings().size()).containsExactly(6, 8);
        assertThat(causes).extracting(Counterexample::sentence).containsExactly(SERVICE_WAITS, ROBOT_WAITS);
    }

    @Test
    void pairs_showTheirCauses() {
        var pairs = deadlock(PaperWiring.wiring()).pairs();
        assertThat(pairs)
                .extracting(PairResult::one, PairResult::other, PairResult::figures, PaperWiringTest::sentences)
                .containsExactlyInAnyOrder(
                        tuple("robot", "player", figures(17, 15, 38, 28, 43, 1), List.of(ROBOT_WAITS)),
                        tuple("player", "middleware", figures(10, 10, 24, 14, 27, 0), List.of()),
                        tuple(
                                "middleware",
                                "service",
                                figures(17, 16, 40, 32, 55, 2),
                                List.of(SERVICE_WAITS, BOTH_ASK)));
        assertThat(pairs).extracting(PairResult::isFree).containsExactly(false, true, false);
        assertThat(pairs.getFirst().counterexamples().getFirst().firings())
                .hasSize(8)
                .endsWith("player stops", "robot asks player.setValues");
    }

    @Test
    void repair_stopsWhereEachWaitsForItsNextCall_andIsProved() {
        var repair = deadlock(PaperWiring.wiring()).repair().orElseThrow();
        var ready = List.of("ready");
        assertThat(repair.isProved()).isTrue();
        assertThat(repair.stops())
                .isEqualTo(Map.of("robot", List.of("leaving"), "player", ready, "middleware", ready, "service", ready));
        assertThat(repair.result().figures()).isEqualTo(figures(38, 30, 86, 429, 1084, 0));
        assertThat(repair.toString()).contains("proved free of deadlock", "429 markings");
    }

    @Test
    void deadlock_inAPartOfTheGraph_isReportedWithoutCauses() {
        var complete = ReachabilityGraph.explore(PaperWiring.wiring().net());
        var limit = complete.dead().getFirst().index() + 1;
        var result = (Deadlock) WiringCheck.check(PaperWiring.wiring(), limit);
        assertThat(result.figures().isComplete()).isFalse();
        assertThat(result.reduced().isComplete()).isTrue();
        assertThat(result.counterexample().firings()).hasSize(14);
        assertThat(result.causes()).isEmpty();
    }

    @ParameterizedTest
    @CsvSource({
        "1, 6, 14, 1264, 429", "2, 18, 22, 49536, 11653", "3, 54, 30, 100000, 100000",
        "4, 162, 38, 100000, 100000", "5, 486, 46, 100000, 100000", "6, 1458, 54, 100000, 100000"
    })
    void robots_thatStopWhenTheyLike_haveAllDeadMarkingsAndACounterexample(
            int robots, int dead, int firings, int markings, int repairedMarkings) {
        var wiring = PaperWiring.robots(robots);
        var net = wiring.net();
        var result = (Deadlock) WiringCheck.check(wiring, SMALL);
        assertThat(result.reduced().end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(result.reduced().deadMarkings()).isEqualTo(dead);
        assertThat(result.counterexample().sentence())
                .isEqualTo("player1 stops; robot1 waits for player1.setValues, which no component will answer");
        assertThat(result.counterexample().firings()).hasSize(firings);
        assertThat(net.enabled(end(net, result.counterexample()))).isEmpty();
        assertThat(result.figures().markings()).isEqualTo(markings);
        assertThat(result.figures().isComplete()).isEqualTo(robots <= 2);
        if (robots <= 2) {
            assertThat(result.figures().deadMarkings()).isEqualTo(dead);
        }
        var repair = result.repair().orElseThrow();
        assertThat(repair.isProved()).isTrue();
        assertThat(repair.result().figures().markings()).isEqualTo(repairedMarkings);
    }

    /** The correct wiring of six robots: all stop together. */
    @Test
    void sixRobots_thatStopTogether_areProved() {
        var wiring = PaperWiring.robots(6).withSynchronisedStop();
        var result = WiringCheck.check(wiring, SMALL);
        assertThat(result).isInstanceOf(Proved.class);
        assertThat(result.reduced().isComplete()).isTrue();
        assertThat(result.reduced().deadMarkings()).isZero();
        assertThat(result.figures().end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(result.toString()).contains("proved free of deadlock", "stopped at this limit", "by stubborn sets");
        assertThat(wiring.net().transitions())
                .filteredOn(transition -> transition.name().startsWith("all stop"))
                .hasSize(1);
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 3, 6})
    void robots_thatStopWithTheirPlayerEach_areProved(int robots) {
        var wiring = PaperWiring.robotsStoppingOneByOne(robots);
        assertThat(WiringCheck.check(wiring, SMALL)).isInstanceOf(Proved.class);
    }

    @Test
    void pairs_thatAreAlike_areSearchedOnceAndToldByTheirOwnNames() {
        var check = new WiringCheck.PairCheck(PaperWiring.robots(6), SMALL);

        var results = check.results();

        assertThat(results).hasSize(13);
        assertThat(check.searched()).isEqualTo(3);
        assertThat(results)
                .filteredOn(pair -> pair.one().equals("robot6"))
                .singleElement()
                .satisfies(pair -> {
                    assertThat(pair.counterexamples()).hasSize(1);
                    var counterexample = pair.counterexamples().getFirst();
                    assertThat(counterexample.sentence())
                            .isEqualTo(
                                    "player6 stops; robot6 waits for player6.setValues, which no component will answer");
                    assertThat(counterexample.firings()).hasSize(8).allMatch(step -> step.contains("6"));
                    assertThat(counterexample.circle())
                            .extracting(Wait::component)
                            .containsExactly("robot6", "player6");
                    assertThat(pair.figures().neverReached()).isEmpty();
                });
    }

    /** An independent clock makes the full graph larger, but neither the graph of the search nor the block. */
    @Test
    void block_beyondTheFullGraph_isToldWithAWay() {
        var clock = Protocol.of("clock")
                .state("tick", does("tick").then("tock"))
                .state("tock", does("tock").then("tick"))
                .build();
        var wiring = Wiring.of("blocked").components("clock", 2, clock);
        for (var i = 1; i <= 4; i++) {
            wiring.component("robot" + i, PaperWiring.robot())
                    .component("player" + i, PaperWiring.player())
                    .bind("robot" + i, "player", "player" + i);
        }
        var whole = wiring.component(PaperWiring.middleware())
                .component(PaperWiring.service())
                .build();
        var net = whole.net();

        var result = (Blocked) WiringCheck.check(whole, SMALL);

        assertThat(result.figures().isComplete()).isFalse();
        assertThat(result.reduced().showsBlocks()).isTrue();
        var counterexample = result.counterexample();
        assertThat(counterexample.isShortest()).isFalse();
        assertThat(counterexample.toString()).contains("steps, perhaps not the fewest");
        assertThat(counterexample.waits())
                .hasSize(10)
                .noneMatch(wait -> wait.component().startsWith("clock"));
        assertThat(net.enabled(end(net, counterexample)))
                .allMatch(transition -> transition.name().startsWith("clock"));
        assertThat(result.repair().orElseThrow().isDeadlockFree()).isTrue();
    }

    /** 50 markings are too few for the searches of the whole, but not for a hunt. */
    @Test
    void limits_thatEndTheSearches_leaveTheHuntForOneDeadlock() {
        var result = (Deadlock) WiringCheck.check(PaperWiring.robots(6), 50);
        assertThat(result.reduced().method()).isEqualTo("a hunt");
        assertThat(result.figures().markings()).isEqualTo(50);
        assertThat(result.counterexample().isShortest()).isFalse();
        assertThat(result.toString()).contains("can deadlock", "50 markings (stopped at this limit)");
        var unknown = new Unknown(result.figures(), result.reduced(), List.of());
        assertThat(unknown.toString()).contains("not known", "50 markings (stopped at this limit)");
    }

    @Test
    void check_reportsAndCanBeCancelled() {
        var stop = new AtomicBoolean();
        var reports = new AtomicInteger();
        var limits = SMALL.cancelledBy(stop::get).reporting(50, progress -> {
            reports.incrementAndGet();
            stop.set(true);
        });
        var result = WiringCheck.check(PaperWiring.robots(6), limits);
        assertThat(reports).hasValue(1);
        assertThat(result).isInstanceOf(Unknown.class);
        assertThat(result.reduced().end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(result.figures().end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(result.toString()).contains("(cancelled)");
    }

    /** The limit is too low for the second search by stubborn sets, which enlarges loops, but enough for the first. */
    @Test
    void noDeadMarking_withoutAWordOnBlocks_isNotCalledProved() {
        var ticking = Protocol.of("clock")
                .state("one", does("one").then("two"))
                .state("two", does("two").then("three"))
                .state("three", does("three").then("one"))
                .build();
        var wiring = Wiring.of("clocks").components("clock", 8, ticking).build();
        var result = WiringCheck.check(wiring, 100);
        assertThat(result).isInstanceOf(DeadlockFree.class);
        assertThat(result.reduced()).isEqualTo(new ReducedFigures("stubborn sets", 3, 3, 0, SearchEnd.COMPLETE, false));
        assertThat(result.toString()).contains("never all wait for ever", "not known whether one can");
    }

    @Test
    void groups_thatMakeNoSense_areRefused() {
        var wiring = PaperWiring.robots(2);
        var first = Set.of("robot1", "player1");
        var clock = Protocol.of("clock").state("on", does("tick").then("on")).build();
        var ticking = Wiring.of("w").component(clock).build();
        assertThatIllegalArgumentException()
                .isThrownBy(() -> wiring.withSynchronisedStops(List.of(first, Set.of("robot1"))))
                .withMessageContaining("robot1 stops in two groups");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> wiring.withSynchronisedStops(List.of(Set.of("robot3"))))
                .withMessageContaining("there is no component robot3");
        refused(
                () -> wiring.withSynchronisedStops(List.of(first)),
                "wiring 2 robots: robot2 is in no group that stops, but can do nothing else in state leaving");
        refused(
                () -> ticking.withSynchronisedStops(List.of(Set.of("clock"))),
                "wiring w: no component stops in group [clock]; expected a component that declares a stop");
    }
}
