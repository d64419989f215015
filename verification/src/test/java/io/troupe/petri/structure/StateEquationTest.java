package io.troupe.petri.structure;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static io.troupe.petri.PaperNets.Reading.A;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.petri.Nets;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.Verdict;
import io.troupe.tools.Thorough;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The fewest tokens of siphons: by marked traps, by the state equation, and in all markings. */
class StateEquationTest {

    @ParameterizedTest
    @CsvSource({"A, false, 44, 20", "A, true, 48, 0", "B, false, 36, 12", "B, true, 48, 0"})
    void paperNet_trapsStateEquationAndReachabilityAgreeOnEverySiphon(
            Reading reading, boolean corrected, int count, int emptiable) {
        var net = Nets.paper(reading, corrected);
        var graph = ReachabilityGraph.explore(net);
        var equation = new StateEquation(net);
        var siphons = Siphons.minimalSiphons(net).sets();
        assertThat(siphons).hasSize(count);
        assertThat(siphons).filteredOn(siphon -> isEmptied(siphon, graph)).hasSize(emptiable);
        assertThat(siphons).allSatisfy(siphon -> {
            var isEmptied = isEmptied(siphon, graph);
            assertThat(holdsMarkedTrap(siphon)).isEqualTo(!isEmptied);
            assertThat(equation.leastTokens(siphon).orElseThrow()).isCloseTo(isEmptied ? 0 : 1, within(1e-9));
            var bound = equation.lowerBound(siphon).map(TokenBound::tokens);
            assertThat(bound).isEqualTo(isEmptied ? Optional.empty() : Optional.of(1L));
        });
        assertThat(graph.deadlockFree()).isEqualTo(corrected ? Verdict.YES : Verdict.NO);
    }

    @ParameterizedTest
    @CsvSource({
        "robot,              '',       1, 0",
        "player,             '',       1, 0",
        "middleware,         '',       1, 0",
        "service,            '',       1, 0",
        "robot player,       Tr2,      4, 0",
        "robot player,       Tr2 Tr4, 12, 1",
        "player middleware,  Tp3,      4, 0",
        "middleware service, Tm2,      4, 0",
        "middleware service, Ts1,      4, 0",
        "middleware service, Ts1 Tm2, 16, 2"
    })
    void part_hasASiphonThatIsEmptiedExactlyWhenItCanDeadlock(
            String components, String requests, int siphons, int dead) {
        var net = Nets.part(components, requests);
        var graph = ReachabilityGraph.explore(net);
        var found = Siphons.minimalSiphons(net).sets();
        assertThat(graph.dead()).hasSize(dead);
        assertThat(found).hasSize(siphons);
        assertThat(found.stream().allMatch(StateEquationTest::holdsMarkedTrap)).isEqualTo(dead == 0);
        assertThat(found)
                .allSatisfy(siphon -> assertThat(holdsMarkedTrap(siphon)).isEqualTo(!isEmptied(siphon, graph)));
    }

    @Test
    void emptiedSiphon_staysEmptyAfterTheTrace() {
        var net = PaperNets.uncorrected(A);
        var siphon = PlaceSet.of(net, "M1", "M4", "M9''", "S3''", "S4", "S7", "S8", "S9", "S10");
        var emptied = ReachabilityGraph.explore(net).states().stream()
                .filter(state -> !siphon.isMarked(state.marking()))
                .findFirst()
                .orElseThrow();
        assertThat(siphon.tokens(net.fire(net.initialMarking(), emptied.shortestTrace())))
                .isZero();
    }

    /** c lets only one of the three tokens of a go, but there is no trap: only the state equation proves it. */
    @Test
    void siphonWithoutMarkedTrap_isProvedByTheStateEquation() {
        var net = net("weights", "a=3 b c=1 d", "t: a c > d");
        var siphon = PlaceSet.of(net, "a");
        assertThat(holdsMarkedTrap(siphon)).isFalse();
        var bound = new StateEquation(net).lowerBound(siphon).orElseThrow();
        assertThat(bound.tokens()).isEqualTo(2);
        assertThat(bound.set()).isEqualTo(siphon);
        assertThat(new StateEquation(net).leastTokens(siphon).orElseThrow()).isCloseTo(2, within(1e-9));
    }

    /** The constructor of a proof checks it. */
    @Test
    void proofs_thatProveNothing_areRefused() {
        var net = PaperNets.player();
        var p1 = PlaceSet.of(net, "P1");
        var all = PlaceSet.of(net, net.places());

        refused(
                () -> new TokenBound(p1, Map.of(net.place("P1"), 1L), 1),
                "transition Tp1 changes the weighted sum by -1, expected 0 or more");
        refused(
                () -> new TokenBound(p1, Map.of(net.place("P4"), 1L), 1),
                "place P4 weighs 1, expected 0 or less for a bound on {P1}");
        for (var scale : List.of(1L, 2L)) {
            var weights = Map.of(net.place("P1"), scale, net.place("P4"), scale, net.place("P7"), scale);
            assertThat(new TokenBound(all, weights, scale).tokens()).isEqualTo(1);
        }
    }

    /** The cases that occurred, which proves that the comparison was not empty. */
    private final Set<String> seen = new HashSet<>();

    /**
     * Small random nets, compared with their markings. If there are too many, the visited ones can still refute a wrong
     * proof. A result without a proof may be right or wrong, and is not compared.
     */
    @ParameterizedTest
    @ValueSource(ints = {1, 2})
    void bounds_areNeverRefutedByAReachableMarking(int maxWeight) {
        for (var seed = 1L; seed <= Thorough.times(250, 500); seed++) {
            var net = Nets.sparse(seed, maxWeight);
            var graph = ReachabilityGraph.explore(net, 400);
            var equation = new StateEquation(net);
            for (var siphon : Siphons.minimalSiphons(net).sets()) {
                checkSiphon("seed " + seed + ", " + siphon, siphon, equation, graph);
            }
        }
        assertThat(seen).contains("emptied", "by trap", "by state equation", "false candidate");
    }

    private void checkSiphon(String as, PlaceSet siphon, StateEquation equation, ReachabilityGraph graph) {
        var tokens = graph.states().stream().mapToLong(state -> siphon.tokens(state.marking()));
        var fewest = tokens.min().orElseThrow();
        var bound = equation.lowerBound(siphon).map(TokenBound::tokens);
        var least = equation.leastTokens(siphon).orElseThrow();
        assertThat(least).as(as).isLessThan(fewest + 1e-6);
        bound.ifPresent(proved -> assertThat(proved)
                .as(as)
                .isBetween(1L, fewest)
                .isEqualTo(Math.ceilDiv(Math.round(least * 1000), 1000L)));
        if (holdsMarkedTrap(siphon)) {
            assertThat(fewest).as(as).isPositive();
            seen.add("by trap");
        } else if (bound.isPresent()) {
            seen.add("by state equation");
        } else {
            seen.add(fewest == 0 ? "emptied" : "false candidate");
        }
    }

    private static boolean holdsMarkedTrap(PlaceSet siphon) {
        return Siphons.largestTrapIn(siphon).isMarked(siphon.net().initialMarking());
    }

    private static boolean isEmptied(PlaceSet siphon, ReachabilityGraph graph) {
        return graph.states().stream().anyMatch(state -> !siphon.isMarked(state.marking()));
    }
}
