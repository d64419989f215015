package io.troupe.petri;

import static io.troupe.petri.Nets.part;
import static io.troupe.petri.Nets.refused;
import static java.util.stream.Collectors.toMap;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.ReachabilityGraph.State;
import java.net.URISyntaxException;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.HashMap;
import java.util.Map;
import java.util.Objects;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The paper's nets, and those of its robots in teams. */
class PaperNetsTest {
    private static PetriNet fixture(String name) throws URISyntaxException {
        var resource = Objects.requireNonNull(PaperNetsTest.class.getResource(name), name);
        return Pnml.read(Path.of(resource.toURI()));
    }

    /** The marking after a firing sequence. */
    private static Marking end(PetriNet net, String names) {
        var sequence = Arrays.stream(names.split(" ")).map(net::transition).toList();
        return net.fire(net.initialMarking(), sequence);
    }

    /** The dead markings with the lengths of their shortest traces. */
    private static Map<Marking, Integer> dead(ReachabilityGraph graph) {
        var states = graph.dead().stream();
        return states.collect(
                toMap(State::marking, state -> state.shortestTrace().size()));
    }

    private static PetriNet team(String design, int robots) {
        return switch (design) {
            case "uncorrected" -> RobotTeams.uncorrected(robots);
            case "together" -> RobotTeams.stoppingTogether(robots);
            case "oneByOne" -> RobotTeams.stoppingOneByOne(robots);
            default -> throw new IllegalArgumentException(design);
        };
    }

    @ParameterizedTest
    @CsvSource({"A, uncorrected.pnml, corrected.pnml", "B, uncorrected-literal36.pnml, corrected-literal36.pnml"})
    void nets_composedInCode_equalTheFiles(Reading reading, String uncorrected, String corrected)
            throws URISyntaxException {
        assertThat(PaperNets.uncorrected(reading).structure())
                .isEqualTo(fixture(uncorrected).structure());
        assertThat(PaperNets.corrected(reading).structure())
                .isEqualTo(fixture(corrected).structure());
    }

    /** Places, transitions, arcs; markings, edges, dead markings. */
    private static String numbers(ReachabilityGraph graph) {
        var net = graph.net();
        assertThat(graph.isComplete()).isTrue();
        return "%d %d %d; ".formatted(net.places().size(), net.transitions().size(), net.arcCount())
                + "%d %d %d"
                        .formatted(graph.size(), graph.edgeCount(), graph.dead().size());
    }

    @ParameterizedTest
    @CsvSource({
        "A, false, 38 33 86; 1264 3706 6",
        "A, true,  38 30 86; 429 1084 0",
        "B, false, 37 32 84; 1104 3236 3",
        "B, true,  37 29 84; 363 913 0"
    })
    void wholeNet_hasTheKnownNumbers(Reading reading, boolean corrected, String numbers) {
        var graph = ReachabilityGraph.explore(Nets.paper(reading, corrected));
        assertThat(numbers(graph)).isEqualTo(numbers);
        assertThat(graph.deadlockFree()).isEqualTo(corrected ? Verdict.YES : Verdict.NO);
        assertThat(graph.mostTokens()).isEqualTo(1);
        assertThat(graph.neverMarked()).isEmpty();
        assertThat(graph.neverFired()).isEmpty();
        for (var state : graph.states()) {
            assertThat(state.marking().marked().stream()
                            .map(place -> place.name().substring(0, 1)))
                    .as("each component is in one place")
                    .containsExactlyInAnyOrder("R", "P", "M", "S");
        }
    }

    @ParameterizedTest
    @CsvSource({
        "robot,              '',      6 7 14; 6 7 0",
        "player,             '',      3 4 8; 3 4 0",
        "middleware,         '',      3 4 8; 3 4 0",
        "service,            '',      6 8 16; 6 8 0",
        "robot player,       Tr2,     13 13 30; 23 45 0",
        "robot player,       Tr2 Tr4, 17 15 38; 28 43 1",
        "player middleware,  Tp3,     10 10 24; 14 27 0",
        "middleware service, Tm2,     13 14 32; 26 55 0",
        "middleware service, Ts1,     13 14 32; 23 48 0",
        "middleware service, Ts1 Tm2, 17 16 40; 32 55 2"
    })
    void part_ofReadingA_hasTheKnownNumbers(String components, String requests, String numbers) {
        assertThat(numbers(ReachabilityGraph.explore(part(components, requests))))
                .isEqualTo(numbers);
    }

    @Test
    void pairs_showBothCausesOfTheDeadlock() {
        var one = part("robot player", "Tr2 Tr4");
        var other = part("middleware service", "Ts1 Tm2");
        assertThat(dead(ReachabilityGraph.explore(one))).isEqualTo(Map.of(one.marking("P1", "R7''"), 8));
        assertThat(dead(ReachabilityGraph.explore(other)))
                .isEqualTo(Map.of(other.marking("M1", "S10"), 6, other.marking("S2''", "M8''"), 8));
        assertThat(end(one, "Tr1 Tr2'' Trp1'' Tp1 Trp2'' Tr3 Tr4'' Tp4")).hasToString("{P1, R7''}");
        assertThat(end(other, "Ts1'' Tms1'' Tm1 Tms2'' Tm4 Ts8")).hasToString("{M1, S10}");
        assertThat(end(other, "Ts1'' Tms1'' Tm1 Tms2'' Tm3 Tm2'' Ts7 Ts1''")).hasToString("{S2'', M8''}");
    }

    @Test
    void uncorrectedA_hasTheSixKnownDeadMarkings() {
        var net = PaperNets.uncorrected(Reading.A);
        var graph = ReachabilityGraph.explore(net);
        assertThat(dead(graph))
                .isEqualTo(Map.of(
                        net.marking("P1", "M1", "S10", "R7''"), 14,
                        net.marking("M1", "S10", "R7''", "P8''"), 20,
                        net.marking("M1", "S10", "R3''", "P8''"), 21,
                        net.marking("P1", "R7''", "S2''", "M8''"), 25,
                        net.marking("R7''", "P8''", "S2''", "M8''"), 31,
                        net.marking("R3''", "P8''", "S2''", "M8''"), 32));
        assertThat(graph.dead()).allSatisfy(state -> {
            assertThat(net.fire(net.initialMarking(), state.shortestTrace())).isEqualTo(state.marking());
            assertThat(net.enabled(state.marking())).isEmpty();
        });
        var known = "Tr1 Tr2'' Trp1'' Tp1 Trp2'' Tr3 Tr4'' Tp4 Ts1'' Tms1'' Tm1 Tms2'' Tm4 Ts8";
        assertThat(end(net, known)).isEqualTo(graph.dead().getFirst().marking());
    }

    @Test
    void uncorrectedB_hasTheThreeKnownDeadMarkings() {
        var net = PaperNets.uncorrected(Reading.B);
        assertThat(dead(ReachabilityGraph.explore(net)))
                .isEqualTo(Map.of(
                        net.marking("P1", "R7''", "S2''", "M8''"), 25,
                        net.marking("R7''", "P8''", "S2''", "M8''"), 31,
                        net.marking("R3''", "P8''", "S2''", "M8''"), 32));
    }

    @ParameterizedTest
    @CsvSource({"A, 38 33 86; 360 891 0", "B, 37 32 84; 305 751 0"})
    void stops_ofLowerPriority_neverFire(Reading reading, String numbers) {
        var net = PaperNets.lowPriorityStops(reading);
        var graph = ReachabilityGraph.explore(net);
        assertThat(numbers(graph)).isEqualTo(numbers);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.YES);
        assertThat(graph.neverFired())
                .extracting(Transition::name)
                .containsExactlyInAnyOrder("Tr6", "Tr7", "Tp4", "Tm4", "Ts7");
        assertThat(graph.neverMarked()).containsExactly(net.place("R10"));
    }

    @Test
    void correctedA_onceTheRobotWantsToStop_stopsWithinTwentyOneFirings() {
        var net = PaperNets.corrected(Reading.A);
        var stop = net.transition("Tstop");
        var states = ReachabilityGraph.explore(net).states();
        var wish = net.marking("R10");
        var stopping =
                states.stream().filter(state -> state.marking().covers(wish)).toList();

        // the longest firing sequence from each stopping state to Tstop, which is excluded; a cycle would not settle
        // within this number of rounds
        var longest = new HashMap<State, Integer>();
        for (var round = 0; round <= stopping.size(); round++) {
            for (var state : stopping) {
                var lengths = state.successors().stream()
                        .map(edge -> edge.transition().equals(stop) ? 0 : 1 + longest.getOrDefault(edge.target(), 0));
                longest.put(state, lengths.max(Integer::compare).orElseThrow());
            }
        }

        assertThat(stopping).hasSize(69);
        assertThat(longest.values().stream().max(Integer::compare)).hasValue(21);
        assertThat(states)
                .filteredOn(state -> net.enabled(state.marking()).contains(stop))
                .singleElement()
                .satisfies(state -> {
                    assertThat(state.shortestTrace()).hasSize(27);
                    assertThat(net.fire(state.marking(), stop)).isEqualTo(net.initialMarking());
                });
    }

    @Test
    void teamOfOne_isThePapersNet_andOfNoneIsRefused() {
        var uncorrected = RobotTeams.uncorrected(1).renamed("one", name -> name.replace(".1", ""));
        var corrected = RobotTeams.stoppingTogether(1).renamed("one", name -> name.replace(".1", ""));
        assertThat(uncorrected.structure())
                .isEqualTo(PaperNets.uncorrected(Reading.A).structure());
        assertThat(corrected.structure())
                .isEqualTo(PaperNets.corrected(Reading.A).structure());
        refused(() -> RobotTeams.stoppingOneByOne(0), "robots is 0, expected 1 or more");
    }

    @ParameterizedTest
    @CsvSource({
        "uncorrected, 1,    1264,  6, NO,  NO",
        "uncorrected, 2,   49536, 18, NO,  NO",
        "together,    1,     429,  0, YES, YES",
        "together,    2,   11653,  0, YES, YES",
        "together,    3,  283741,  0, YES, YES",
        "oneByOne,    1,     504,  0, NO,  NO",
        "oneByOne,    2,   12028,  0, NO,  NO",
        "oneByOne,    3,  285616,  0, NO,  NO"
    })
    void team_hasTheKnownNumbers(String design, int robots, int markings, int dead, Verdict live, Verdict reversible) {
        var graph = ReachabilityGraph.explore(team(design, robots));
        var liveness = Liveness.of(graph);
        assertThat(graph.isComplete()).isTrue();
        assertThat(graph.size()).isEqualTo(markings);
        assertThat(graph.dead()).hasSize(dead);
        assertThat(graph.safe()).isEqualTo(Verdict.YES);
        assertThat(liveness.live()).isEqualTo(live);
        assertThat(liveness.reversible()).isEqualTo(reversible);
        assertThat(liveness.terminalComponents()).hasSize(Math.max(dead, 1));
    }

    /** Takes some seconds and 200 MiB: two million markings, eleven million edges. */
    @Test
    @Tag("slow")
    void threeUncorrectedRobots_haveTheKnownNumbers() {
        var graph = ReachabilityGraph.explore(RobotTeams.uncorrected(3));
        assertThat(graph.isComplete()).isTrue();
        assertThat(graph.size()).isEqualTo(1_928_448);
        assertThat(graph.dead()).hasSize(54);
        assertThat(Liveness.of(graph).terminalComponents()).hasSize(54).allMatch(TerminalComponent::isDead);
    }

    /** The middleware and the service never stop, so only what happens once at their start is not live. */
    @Test
    void robotsStoppingOneByOne_loseTheRegistrationOnly() {
        var liveness = Liveness.of(ReachabilityGraph.explore(RobotTeams.stoppingOneByOne(2)));
        assertThat(liveness.terminalComponents())
                .singleElement()
                .satisfies(component -> assertThat(component.neverFired())
                        .isEqualTo(liveness.notLive())
                        .extracting(Transition::name)
                        .containsExactlyInAnyOrder("Tm1", "Ts1''", "Tms1''", "Tms2''"));
    }

    @ParameterizedTest
    @CsvSource({"uncorrected, 6 18 54 162 486 1458", "together, 0 0 0 0 0 0", "oneByOne, 0 0 0 0 0 0"})
    void deadlockSearch_ofTeamsOfOneToSix_findsAllDeadMarkings(String design, String dead) {
        for (var robots = 1; robots <= 6; robots++) {
            var net = team(design, robots);
            var expected = Integer.parseInt(dead.split(" ")[robots - 1]);
            var search = DeadlockSearch.run(net, SearchLimits.markings(100_000));
            assertThat(search.end()).as(net.name()).isEqualTo(SearchEnd.COMPLETE);
            assertThat(search.deadlocks()).as(net.name()).hasSize(expected).doesNotHaveDuplicates();
            assertThat(search.deadlockFree()).isEqualTo(expected == 0 ? Verdict.YES : Verdict.NO);
            for (var deadlock : search.deadlocks()) {
                assertThat(net.fire(net.initialMarking(), deadlock.trace())).isEqualTo(deadlock.marking());
                assertThat(net.enabled(deadlock.marking())).isEmpty();
            }
        }
    }
}
