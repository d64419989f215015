package io.troupe.petri.structure;

import static io.troupe.petri.PaperNets.Reading.A;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.petri.Marking;
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
        var net = PetriNet.builder("pairs")
                .place("single", 4)
                .place("pair")
                .transition("t")
                .arc("single", "t", 4)
                .arc("t", "pair", 2)
                .build();

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
        for (var state : ReachabilityGraph.explore(net).states()) {
            assertThat(found.invariants())
                    .allMatch(invariant -> sum(invariant, state.marking()) == sum(invariant, net.initialMarking()));
        }
        for (var component : List.of("R", "P", "M", "S")) {
            var ofComponent = new HashMap<Place, Long>();
            net.places().stream()
                    .filter(place -> place.name().startsWith(component))
                    .forEach(place -> ofComponent.put(place, 1L));
            assertThat(found.invariants()).contains(ofComponent);
        }
    }

    @Test
    void limit_isKeptAndSaid() {
        assertThat(Invariants.ofPlaces(PaperNets.corrected(A), 1).isComplete()).isFalse();
        assertThatIllegalArgumentException()
                .isThrownBy(() -> Invariants.ofPlaces(PaperNets.player(), 0))
                .withMessage("maxRows is 0, expected 1 or more");
    }

    @Test
    void randomNets_invariantsHoldAndNoneContainsAnother() {
        var some = 0;
        for (var seed = 1L; seed <= 500; seed++) {
            var net = Nets.random(seed, 2);
            var found = Invariants.ofPlaces(net).invariants();
            var states = ReachabilityGraph.explore(net, 100).states();
            some += found.isEmpty() ? 0 : 1;
            for (var invariant : found) {
                assertThat(states)
                        .as("seed %d", seed)
                        .allMatch(state -> sum(invariant, state.marking()) == sum(invariant, net.initialMarking()));
                assertThat(found)
                        .as("seed %d", seed)
                        .noneMatch(other ->
                                other != invariant && invariant.keySet().containsAll(other.keySet()));
            }
        }
        assertThat(some).isGreaterThan(50);
    }
}
