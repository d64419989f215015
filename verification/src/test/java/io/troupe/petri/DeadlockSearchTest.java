package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PaperNets.Reading;
import java.util.List;
import java.util.Random;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class DeadlockSearchTest {
    private static List<Marking> fullSearch(ReachabilityGraph graph) {
        return graph.dead().stream().map(ReachabilityGraph.State::marking).toList();
    }

    @ParameterizedTest
    @CsvSource({"A, 6, 200", "B, 3, 200"})
    void uncorrectedNet_allDeadMarkingsAreFoundInAFractionOfTheGraph(Reading reading, int dead, int atMost) {
        var net = PaperNets.uncorrected(reading);

        var search = DeadlockSearch.run(net);

        assertThat(search.deadlocks())
                .hasSize(dead)
                .extracting(DeadlockSearch.Deadlock::marking)
                .containsExactlyInAnyOrderElementsOf(fullSearch(ReachabilityGraph.explore(net)));
        assertThat(search.visitedMarkings()).isLessThan(atMost);
        assertThat(DeadlockSearch.run(PaperNets.corrected(reading)).deadlockFree())
                .isEqualTo(Verdict.YES);
    }

    @Test
    void stops_ofLowerPriority_areSearchedInFull() {
        var net = PaperNets.lowPriorityStops(Reading.A);

        var search = DeadlockSearch.run(net);

        assertThat(search.deadlockFree()).isEqualTo(Verdict.YES);
        assertThat(search.visitedMarkings()).isEqualTo(360);
        assertThat(search.visitedEdges()).isEqualTo(891);
    }

    /** n independent steps: 2^n markings, of which one order of firings is enough. */
    @Test
    void independentSteps_areTakenInOneOrder() {
        var net = PetriNet.builder("steps");
        for (var i = 0; i < 40; i++) {
            net.place("a" + i, 1).place("b" + i).transition("t" + i, List.of("a" + i), List.of("b" + i));
        }

        var search = DeadlockSearch.run(net.build());

        assertThat(search.visitedMarkings()).isEqualTo(41);
        assertThat(search.deadlocks())
                .singleElement()
                .satisfies(dead -> assertThat(dead.trace()).hasSize(40));
    }

    @Test
    void search_thatEndsEarly_saysSo() {
        var net = PaperNets.uncorrected(Reading.A);
        var stop = new AtomicBoolean();
        var limits = SearchLimits.markings(1000).cancelledBy(stop::get).reporting(5, progress -> stop.set(true));

        var limited = DeadlockSearch.run(net, SearchLimits.markings(10));
        var cancelled = DeadlockSearch.run(net, limits);

        assertThat(limited.end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(limited.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(limited).hasToString("uncorrected A: 10 markings visited, 0 dead so far; stopped at the limit");
        assertThat(cancelled.end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(cancelled.toString()).endsWith(" so far; cancelled");
    }

    @Test
    void search_ofDeadlock_tellsTheNearest() {
        var net = PetriNet.builder("end")
                .place("a", 1)
                .place("b")
                .transition("go", List.of("a"), List.of("b"))
                .build();

        assertThat(DeadlockSearch.run(net)).hasToString("""
            end: 2 markings visited, 1 dead, all of them
              the nearest {b} after [go]\
            """);
    }

    /** For any net: the same dead markings as the full graph, with traces that lead to them. */
    @Test
    void search_ofRandomNets_findsExactlyTheDeadMarkingsOfTheFullGraph() {
        var compared = 0;
        var reduced = 0;
        var withDead = 0;
        for (var seed = 1L; seed <= 2000; seed++) {
            var net = RandomNets.any(new Random(seed));
            var graph = ReachabilityGraph.explore(net, 3000);
            if (!graph.isComplete()) {
                continue;
            }
            var search = DeadlockSearch.run(net, SearchLimits.markings(3000));
            compared++;
            reduced += search.visitedMarkings() < graph.size() ? 1 : 0;
            withDead += graph.dead().isEmpty() ? 0 : 1;

            assertThat(search.end()).as("seed %d", seed).isEqualTo(SearchEnd.COMPLETE);
            assertThat(search.deadlocks())
                    .as("seed %d", seed)
                    .extracting(DeadlockSearch.Deadlock::marking)
                    .containsExactlyInAnyOrderElementsOf(fullSearch(graph));
            assertThat(search.deadlocks())
                    .as("shortest traces of seed %d", seed)
                    .allMatch(dead -> dead.trace().size()
                            == graph.find(dead.marking())
                                    .orElseThrow()
                                    .shortestTrace()
                                    .size());
            assertThat(search.deadlocks())
                    .as("seed %d", seed)
                    .allMatch(
                            dead -> net.fire(net.initialMarking(), dead.trace()).equals(dead.marking()));
        }
        assertThat(compared).isGreaterThan(1500);
        assertThat(reduced).isGreaterThan(500);
        assertThat(withDead).isGreaterThan(500);
    }
}
