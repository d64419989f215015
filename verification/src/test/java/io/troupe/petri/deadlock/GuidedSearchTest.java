package io.troupe.petri.deadlock;

import static io.troupe.petri.Nets.net;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Nets;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Transition;
import io.troupe.petri.structure.DeadlockEquation;
import io.troupe.tools.Thorough;
import java.util.HashMap;
import java.util.List;
import java.util.Optional;
import java.util.Random;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

class GuidedSearchTest {
    private static Optional<int[]> search(PetriNet net, long firings) {
        var hint = new HashMap<Transition, Long>();
        if (DeadlockEquation.solve(net, 20_000_000, () -> false, hint::putAll).isPresent()) {
            return Optional.empty();
        }
        var counts = net.transitions().stream()
                .mapToInt(t -> hint.getOrDefault(t, 0L).intValue())
                .toArray();
        return new GuidedSearch(net, counts, () -> false).run(firings);
    }

    /** Of 2^40 ways, only the one with no step to the left ends. */
    @Test
    void solution_leadsThroughManyChoices() {
        var net = PetriNet.builder("choices").place("p0", 1);
        for (var i = 0; i < 40; i++) {
            net.place("p" + (i + 1)).place("left" + i).place("right" + i);
            net.transition("go left" + i, List.of("p" + i), List.of("left" + i, "p" + (i + 1)));
            net.transition("go right" + i, List.of("p" + i), List.of("right" + i, "p" + (i + 1)));
            net.transition("idle" + i, List.of("left" + i), List.of("left" + i));
        }
        var built = net.build();
        var trace = search(built, 200).orElseThrow();
        assertThat(IntStream.of(trace).mapToObj(built.transitions()::get).map(Transition::name))
                .hasSize(40)
                .allMatch(name -> name.startsWith("go right"));
    }

    @Test
    void randomNets_haveTracesToDeadMarkings() {
        var found = 0;
        for (var seed = 1L; seed <= Thorough.times(100, 1_000); seed++) {
            var random = new Random(seed);
            var net = seed % 2 == 0 ? Nets.inhibited(Nets.any(random), random) : Nets.any(random);
            var trace = search(net, 2_000);
            if (trace.isPresent()) {
                found++;
                assertThat(TraceShortener.leadsToDeadMarking(net, trace.get()))
                        .as("seed %d", seed)
                        .isTrue();
            }
        }
        assertThat(found).isGreaterThan(Thorough.times(15, 300));
    }

    @Test
    void search_ends_whenItIsCancelled() {
        var net = net("step", "a=1 b", "go: a > b");
        assertThat(new GuidedSearch(net, new int[] {1}, () -> true).run(10)).isEmpty();
        assertThat(new GuidedSearch(net, new int[] {1}, () -> false).run(10)).contains(new int[] {0});
    }
}
