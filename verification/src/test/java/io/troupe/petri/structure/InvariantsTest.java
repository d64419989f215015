package io.troupe.petri.structure;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static io.troupe.petri.PaperNets.Reading.A;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Marking;
import io.troupe.petri.Nets;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.ReachabilityGraph;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class InvariantsTest {
    private static long sum(Map<Place, Long> invariant, Marking marking) {
        return invariant.entrySet().stream()
                .mapToLong(weight -> weight.getValue() * marking.tokens(weight.getKey()))
                .sum();
    }

    private static void requireConstant(List<Map<Place, Long>> invariants, PetriNet net, int limit, String as) {
        for (var state : ReachabilityGraph.explore(net, limit).states()) {
            assertThat(invariants)
                    .as(as)
                    .allMatch(each -> sum(each, state.marking()) == sum(each, net.initialMarking()));
        }
    }

    @Test
    void component_isOneCycleOfStates() {
        var net = PaperNets.player();

        assertThat(Invariants.ofPlaces(net).invariants())
                .containsExactly(Map.of(net.place("P1"), 1L, net.place("P4"), 1L, net.place("P7"), 1L));
        assertThat(Invariants.ofTransitions(net).invariants())
                .containsExactlyInAnyOrder(
                        Map.of(net.transition("Tp1"), 1L, net.transition("Tp4"), 1L),
                        Map.of(net.transition("Tp2"), 1L, net.transition("Tp3"), 1L));
    }

    @Test
    void weights_areTheSmallestIntegers() {
        var net = net("pairs", "single=4 pair", "t: 4*single > 2*pair");

        assertThat(Invariants.ofPlaces(net).invariants())
                .containsExactly(Map.of(net.place("single"), 1L, net.place("pair"), 2L));
        assertThat(Invariants.ofTransitions(net).invariants()).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void wholeNet_keepsEveryInvariantInEveryMarkingAndHoldsTheComponents(boolean corrected) {
        var net = Nets.paper(A, corrected);

        var found = Invariants.ofPlaces(net);

        assertThat(found.isComplete()).isTrue();
        requireConstant(found.invariants(), net, 10_000, net.name());
        PaperNets.components(net).values().forEach(places -> {
            var ofComponent = new HashMap<Place, Long>();
            places.forEach(place -> ofComponent.put(place, 1L));
            assertThat(found.invariants()).contains(ofComponent);
        });
    }

    @Test
    void limitAndCancellation_areKeptAndSaid() {
        assertThat(Invariants.ofPlaces(PaperNets.corrected(A), 1).isComplete()).isFalse();
        refused(() -> Invariants.ofPlaces(PaperNets.player(), 0), "maxRows is 0, expected 1 or more");
        var net = PaperNets.uncorrected(A);
        for (var questions : List.of(0, 20, 60, 200)) {
            var places = Invariants.ofPlaces(net, Invariants.DEFAULT_MAX_ROWS, SiphonsTest.after(questions));
            var transitions = Invariants.ofTransitions(net, Invariants.DEFAULT_MAX_ROWS, SiphonsTest.after(questions));

            assertThat(places.isComplete()).isFalse();
            assertThat(Invariants.ofPlaces(net).invariants()).containsAll(places.invariants());
            assertThat(transitions.isComplete()).isFalse();
            assertThat(Invariants.ofTransitions(net).invariants()).containsAll(transitions.invariants());
        }
        assertThat(Invariants.ofPlaces(net("places", "p0 p1 p2"), 10, () -> true)
                        .isComplete())
                .isFalse();
    }

    @Test
    void randomNets_invariantsHoldAndNoneContainsAnother() {
        var some = 0;
        for (var seed = 1L; seed <= 500; seed++) {
            var net = Nets.sparse(seed, 2);
            var found = Invariants.ofPlaces(net).invariants();
            some += found.isEmpty() ? 0 : 1;
            requireConstant(found, net, 100, "seed " + seed);
            for (var one : found) {
                assertThat(found)
                        .as("seed %d", seed)
                        .noneMatch(other -> other != one && one.keySet().containsAll(other.keySet()));
            }
        }
        assertThat(some).isGreaterThan(50);
    }
}
