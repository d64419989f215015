package io.troupe.petri.deadlock;

import static io.troupe.petri.Nets.net;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.common.measure.Thorough;
import io.troupe.petri.Nets;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.deadlock.Boundedness.Bounded;
import io.troupe.petri.deadlock.Boundedness.Unbounded;
import io.troupe.petri.deadlock.Boundedness.Unknown;
import java.util.Random;
import org.junit.jupiter.api.Test;

class BoundednessTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(3000);

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
