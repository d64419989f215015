package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PaperNets.Reading;
import java.net.URISyntaxException;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

class PaperNetsTest {
    private static PetriNet fixture(String name) throws URISyntaxException {
        return Pnml.read(Path.of(
                Objects.requireNonNull(PaperNetsTest.class.getResource(name)).toURI()));
    }

    /** The marking after a firing sequence. */
    private static Marking end(PetriNet net, String names) {
        return net.fire(
                net.initialMarking(),
                Arrays.stream(names.split(" ")).map(net::transition).toList());
    }

    /** The dead markings with the lengths of their shortest traces. */
    private static Map<Marking, Integer> dead(ReachabilityGraph graph) {
        var dead = new HashMap<Marking, Integer>();
        graph.dead()
                .forEach(
                        state -> dead.put(state.marking(), state.shortestTrace().size()));
        return dead;
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

    @ParameterizedTest
    @CsvSource({
        "A, false, 38, 33, 86, 1264, 3706, 6",
        "A, true, 38, 30, 86, 429, 1084, 0",
        "B, false, 37, 32, 84, 1104, 3236, 3",
        "B, true, 37, 29, 84, 363, 913, 0"
    })
    void wholeNet_hasTheKnownNumbers(
            Reading reading,
            boolean corrected,
            int places,
            int transitions,
            int arcs,
            int markings,
            int edges,
            int dead) {
        var net = corrected ? PaperNets.corrected(reading) : PaperNets.uncorrected(reading);

        var graph = ReachabilityGraph.explore(net);

        assertThat(net.places()).hasSize(places);
        assertThat(net.transitions()).hasSize(transitions);
        assertThat(net.arcCount()).isEqualTo(arcs);
        assertThat(graph.isComplete()).isTrue();
        assertThat(graph.size()).isEqualTo(markings);
        assertThat(graph.edgeCount()).isEqualTo(edges);
        assertThat(graph.dead()).hasSize(dead);
        assertThat(graph.deadlockFree()).isEqualTo(corrected ? Verdict.YES : Verdict.NO);
        assertThat(graph.mostTokens()).isEqualTo(1);
        assertThat(graph.neverMarked()).isEmpty();
        assertThat(graph.neverFired()).isEmpty();
    }

    @ParameterizedTest
    @CsvSource({
        "robot,                   '',       6,  7, 14,  6,  7, 0",
        "player,                  '',       3,  4,  8,  3,  4, 0",
        "middleware,              '',       3,  4,  8,  3,  4, 0",
        "service,                 '',       6,  8, 16,  6,  8, 0",
        "robot player,            Tr2,     13, 13, 30, 23, 45, 0",
        "robot player,            Tr2 Tr4, 17, 15, 38, 28, 43, 1",
        "player middleware,       Tp3,     10, 10, 24, 14, 27, 0",
        "middleware service,      Tm2,     13, 14, 32, 26, 55, 0",
        "middleware service,      Ts1,     13, 14, 32, 23, 48, 0",
        "middleware service,      Ts1 Tm2, 17, 16, 40, 32, 55, 2"
    })
    void part_ofReadingA_hasTheKnownNumbers(
            String components,
            String requests,
            int places,
            int transitions,
            int arcs,
            int markings,
            int edges,
            int dead) {
        var graph = ReachabilityGraph.explore(part(components, requests));

        assertThat(graph.net().places()).hasSize(places);
        assertThat(graph.net().transitions()).hasSize(transitions);
        assertThat(graph.net().arcCount()).isEqualTo(arcs);
        assertThat(graph.size()).isEqualTo(markings);
        assertThat(graph.edgeCount()).isEqualTo(edges);
        assertThat(graph.dead()).hasSize(dead);
    }

    private static PetriNet part(String components, String requests) {
        var byName = Map.of(
                "robot",
                PaperNets.robot(),
                "player",
                PaperNets.player(),
                "middleware",
                PaperNets.middleware(),
                "service",
                PaperNets.service(Reading.A));
        return Composition.compose(
                components,
                Arrays.stream(components.split(" ")).map(byName::get).toList(),
                PaperNets.melds().stream()
                        .filter(meld -> List.of(requests.split(" ")).contains(meld.request()))
                        .toList());
    }

    @Test
    void pairs_showBothCausesOfTheDeadlock() {
        var robotPlayer = ReachabilityGraph.explore(part("robot player", "Tr2 Tr4"));
        var middlewareService = ReachabilityGraph.explore(part("middleware service", "Ts1 Tm2"));

        assertThat(dead(robotPlayer)).isEqualTo(Map.of(robotPlayer.net().marking("P1", "R7''"), 8));
        assertThat(dead(middlewareService))
                .isEqualTo(Map.of(
                        middlewareService.net().marking("M1", "S10"),
                        6,
                        middlewareService.net().marking("S2''", "M8''"),
                        8));
        assertThat(end(robotPlayer.net(), "Tr1 Tr2'' Trp1'' Tp1 Trp2'' Tr3 Tr4'' Tp4"))
                .hasToString("{P1, R7''}");
        assertThat(end(middlewareService.net(), "Ts1'' Tms1'' Tm1 Tms2'' Tm4 Ts8"))
                .hasToString("{M1, S10}");
        assertThat(end(middlewareService.net(), "Ts1'' Tms1'' Tm1 Tms2'' Tm3 Tm2'' Ts7 Ts1''"))
                .hasToString("{S2'', M8''}");
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
        assertThat(end(net, known)).isEqualTo(graph.dead().get(0).marking());
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
    @CsvSource({"P1 R7'', 32, 8", "S2'' M8'', 36, 21", "M1 S10, 36, 6"})
    void block_onceReachedInUncorrectedA_isNeverLeft(String places, int markings, int firings) {
        var net = PaperNets.uncorrected(Reading.A);
        var block = net.marking(places.split(" "));

        var blocked = ReachabilityGraph.explore(net).states().stream()
                .filter(state -> state.marking().covers(block))
                .toList();

        assertThat(blocked).hasSize(markings);
        assertThat(blocked.get(0).shortestTrace()).hasSize(firings);
        assertThat(blocked)
                .allSatisfy(state -> assertThat(state.successors())
                        .allMatch(edge -> edge.target().marking().covers(block)));
    }

    @ParameterizedTest
    @CsvSource({"A, 360, 891", "B, 305, "})
    void stops_ofLowerPriority_neverFire(Reading reading, int markings, Integer edges) {
        var net = PaperNets.lowPriorityStops(reading);

        var graph = ReachabilityGraph.explore(net);

        assertThat(graph.size()).isEqualTo(markings);
        if (edges != null) {
            assertThat(graph.edgeCount()).isEqualTo(edges);
        }
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
        var graph = ReachabilityGraph.explore(net);
        var stopping = graph.states().stream()
                .filter(state -> state.marking().covers(net.marking("R10")))
                .toList();

        // the longest firing sequence from each stopping state to Tstop, which is excluded; a cycle would not settle
        // within this number of rounds
        var longest = new HashMap<ReachabilityGraph.State, Integer>();
        for (var round = 0; round <= stopping.size(); round++) {
            for (var state : stopping) {
                assertThat(state.successors()).isNotEmpty();
                longest.put(
                        state,
                        state.successors().stream()
                                .mapToInt(edge ->
                                        edge.transition().equals(stop) ? 0 : 1 + longest.getOrDefault(edge.target(), 0))
                                .max()
                                .orElseThrow());
            }
        }

        assertThat(stopping).hasSize(69);
        assertThat(longest.values().stream().mapToInt(Integer::intValue).max()).hasValue(21);
        var enabling = graph.states().stream()
                .filter(state -> net.enabled(state.marking()).contains(stop))
                .toList();
        assertThat(enabling).singleElement().satisfies(state -> {
            assertThat(state.shortestTrace()).hasSize(27);
            assertThat(net.fire(state.marking(), stop)).isEqualTo(net.initialMarking());
        });
    }

    @ParameterizedTest
    @EnumSource
    void everyComponent_alwaysIsInOnePlace(Reading reading) {
        for (var net : List.of(PaperNets.uncorrected(reading), PaperNets.corrected(reading))) {
            for (var state : ReachabilityGraph.explore(net).states()) {
                assertThat(state.marking().marked().stream()
                                .map(place -> place.name().substring(0, 1)))
                        .containsExactlyInAnyOrder("R", "P", "M", "S");
            }
        }
    }
}
