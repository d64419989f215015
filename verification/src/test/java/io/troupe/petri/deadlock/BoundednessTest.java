package io.troupe.petri.deadlock;

import static io.troupe.petri.Nets.net;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Nets;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.deadlock.Boundedness.Bounded;
import io.troupe.petri.deadlock.Boundedness.Unbounded;
import io.troupe.petri.deadlock.Boundedness.Unknown;
import io.troupe.tools.Thorough;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

class BoundednessTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(3000);

    /** By place, from the third on: a change of the marking that leaves the fingerprints of {@link TokenGame} alone. */
    static final List<Integer> SAME_PRINT =
            List.of(-1, 1, 2, 0, -4, 3, -1, 1, 1, 0, 1, 2, -1, 0, 1, 1, -1, -3, -1, 1, 1, 0, 0, 0, -1, 2);

    @Test
    void growth_isShownByFiringsThatCanBeRepeated() {
        var net = net("producer", "idle=1 busy n", "start: idle > busy", "make: busy > idle n", "take: 2*n >");
        var limits = LIMITS;
        var result = Boundedness.of(net, limits);
        if (Boundedness.of(net, limits) instanceof Boundedness.Unbounded growth) {
            assertThat(growth.growing()).containsExactly(net.place("n"));
        }
        assertThat(result).isInstanceOf(Unbounded.class);
    }

    @Test
    void result_tellsWhyItIsNotKnown() {
        var net = net("hourglass", "a=9 b", "fall: a > b");
        assertThat(Boundedness.of(net, LIMITS)).isEqualTo(new Bounded(10));
        assertThat(Boundedness.of(net, SearchLimits.markings(5)))
                .isEqualTo(new Unknown("the search ended at its limit of 5 markings"));
        assertThat(Boundedness.of(net, LIMITS.cancelledBy(() -> true)))
                .isEqualTo(new Unknown("the search was cancelled"));
        assertThat(Boundedness.of(net.toBuilder().inhibitor("b", "fall").build(), LIMITS))
                .isEqualTo(new Unknown("with inhibitor arcs or priorities, more tokens may prevent a firing"));
    }

    /**
     * Two markings whose difference is {@link #SAME_PRINT} have one fingerprint. The first way ends in one of them; the
     * other one, from which x grows, is not entered.
     */
    @Test
    void markingsWithOneFingerprint_proveNothing() {
        var net = PetriNet.builder("crafted").place("go", 1).place("x");
        IntStream.range(0, SAME_PRINT.size()).forEach(p -> net.place("p" + p));
        for (var name : List.of("minus", "plus")) {
            net.transition(name, List.of("go"), List.of());
            IntStream.range(0, SAME_PRINT.size())
                    .filter(p -> name.equals("minus") ? SAME_PRINT.get(p) < 0 : SAME_PRINT.get(p) > 0)
                    .forEach(p -> net.arc(name, "p" + p, Math.abs(SAME_PRINT.get(p))));
        }
        var source = "p24"; // the last place that only "minus" marks
        net.transition("grow", List.of(source), List.of(source, "x"));
        assertThat(Boundedness.of(net.build(), SearchLimits.markings(10_000)))
                .isEqualTo(new Unknown("the search ended at its limit of 10000 markings"));
    }

    /** A complete graph means bounded; an unbounded net grows by each repetition. */
    @Test
    void randomNets_areBoundedIfTheirGraphIsFinite() {
        var bounded = 0;
        var unbounded = 0;
        for (var seed = 1L; seed <= Thorough.times(150, 1_500); seed++) {
            var net = seed % 2 == 0 ? Nets.sparse(seed, 2) : Nets.any(new Random(seed));
            var graph = ReachabilityGraph.explore(net, LIMITS);
            switch (Boundedness.of(net, LIMITS)) {
                case Bounded result -> {
                    bounded++;
                    assertThat(graph.isComplete()).as("seed %d", seed).isTrue();
                    assertThat(result.markings()).as("seed %d", seed).isEqualTo(graph.size());
                }
                case Unbounded growth -> {
                    unbounded++;
                    assertThat(graph.isComplete()).as("seed %d", seed).isFalse();
                    var before = net.fire(net.initialMarking(), growth.before());
                    var once = net.fire(before, growth.repeated());
                    var twice = net.fire(once, growth.repeated());
                    assertThat(once.covers(before)).as("seed %d", seed).isTrue();
                    assertThat(growth.growing())
                            .as("seed %d", seed)
                            .isNotEmpty()
                            .allMatch(place -> twice.tokens(place) > once.tokens(place));
                }
                case Unknown unknown ->
                    assertThat(net.transitions())
                            .as("seed %d: %s", seed, unknown)
                            .satisfiesAnyOf(
                                    all -> assertThat(all).anyMatch(t -> t.priority() != 0),
                                    all -> assertThat(graph.isComplete()).isFalse());
            }
        }
        assertThat(bounded).isGreaterThan(Thorough.times(25, 500));
        assertThat(unbounded).isGreaterThan(Thorough.times(10, 200));
    }
}
