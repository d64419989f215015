package io.troupe.petri;

import static io.troupe.petri.Nets.net;
import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;

import com.sun.management.ThreadMXBean;
import io.troupe.petri.PaperNets.Reading;
import java.lang.management.ManagementFactory;
import java.util.List;
import java.util.Random;
import java.util.Set;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The searches by stubborn sets: {@link DeadlockSearch} and {@link ProgressSearch}. */
class ReducedSearchTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(100_000);

    private static List<Marking> deadMarkings(ReachabilityGraph graph) {
        return graph.dead().stream().map(ReachabilityGraph.State::marking).toList();
    }

    /** Circles of {@code length} places, each with a token that moves round independently. */
    private static PetriNet circles(int count, int length) {
        var net = PetriNet.builder("circles");
        for (var c = 0; c < count; c++) {
            for (var i = 0; i < length; i++) {
                net.place("p" + c + "." + i, i == 0 ? 1 : 0);
            }
            for (var i = 0; i < length; i++) {
                var next = "p" + c + "." + (i + 1) % length;
                net.transition("t" + c + "." + i, List.of("p" + c + "." + i), List.of(next));
            }
        }
        return net.build();
    }

    private static long allocated(Runnable work) {
        var threads = (ThreadMXBean) ManagementFactory.getThreadMXBean();
        var before = threads.getCurrentThreadAllocatedBytes();
        work.run();
        return threads.getCurrentThreadAllocatedBytes() - before;
    }

    @ParameterizedTest
    @CsvSource({"A, 6, 200", "B, 3, 200"})
    void uncorrectedNet_allDeadMarkingsAreFoundInAFractionOfTheGraph(Reading reading, int dead, int atMost) {
        var net = PaperNets.uncorrected(reading);

        var search = DeadlockSearch.run(net);

        assertThat(search.deadlocks())
                .hasSize(dead)
                .extracting(DeadlockSearch.Deadlock::marking)
                .containsExactlyInAnyOrderElementsOf(deadMarkings(ReachabilityGraph.explore(net)));
        assertThat(search.visitedMarkings()).isLessThan(atMost);
        var corrected = DeadlockSearch.run(PaperNets.corrected(reading));
        assertThat(corrected.deadlockFree()).isEqualTo(Verdict.YES);
    }

    @Test
    void stops_ofLowerPriority_areSearchedInFull() {
        var search = DeadlockSearch.run(PaperNets.lowPriorityStops(Reading.A));

        assertThat(search.deadlockFree()).isEqualTo(Verdict.YES);
        assertThat(search.visitedMarkings()).isEqualTo(360);
        assertThat(search.visitedEdges()).isEqualTo(891);
    }

    /** 2^40 markings, of which one order of firings is enough. */
    @Test
    void independentSteps_areTakenInOneOrder() {
        var search = DeadlockSearch.run(Nets.switches(40));

        assertThat(search.visitedMarkings()).isEqualTo(41);
        assertThat(search.deadlocks())
                .singleElement()
                .satisfies(dead -> assertThat(dead.trace()).hasSize(40));
    }

    @Test
    void deadlockSearch_tellsTheNearest_andThatItEndedEarly() {
        var net = PaperNets.uncorrected(Reading.A);
        var stop = new AtomicBoolean();
        var limits = SearchLimits.markings(1000).cancelledBy(stop::get).reporting(5, progress -> stop.set(true));

        var limited = DeadlockSearch.run(net, SearchLimits.markings(10));
        var cancelled = DeadlockSearch.run(net, limits);

        assertThat(DeadlockSearch.run(net("end", "a=1 b", "go: a > b"))).hasToString("""
            end: 2 markings visited, 1 dead, all of them
              the nearest {b} after [go]\
            """);
        assertThat(limited.end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(limited.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(limited).hasToString("uncorrected A: 10 markings visited, 0 dead so far; stopped at the limit");
        assertThat(cancelled.end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(cancelled.toString()).endsWith(" so far; cancelled");
    }

    /** With two priorities stubborn sets follow all transitions, so that both searches visit the same markings. */
    @Test
    void deadlockSearch_keepsNoEdges() {
        var net = Nets.switches(14).toBuilder()
                .place("key")
                .transition("last", List.of("key"), List.of())
                .priority("last", 1)
                .build();
        var limits = SearchLimits.markings(1 << 20).within(2 << 20);

        var search = DeadlockSearch.run(net, limits);
        var graph = ReachabilityGraph.explore(net, limits);

        assertThat(search.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(search.visitedMarkings()).isEqualTo(1 << 14);
        assertThat(search.visitedEdges()).isEqualTo(14 << 13);
        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isLessThan(1 << 14);
    }

    @Test
    void deadlocks_areMadeWhenTheyAreAskedFor() {
        var search = DeadlockSearch.run(Nets.choices(12));

        var dead = search.deadlocks();

        assertThat(dead).hasSize(1 << 12);
        // 4,096 traces of 12 firings would take more than 300 kB
        assertThat(allocated(() -> assertThat(search.deadlocks().size()).isPositive()))
                .isLessThan(20_000);
        assertThat(dead.get(4095).trace()).hasSize(12);
    }

    /** A row of places. Comparing all pairs of 2,000 transitions would need 4,000,000 pairs and hundreds of MiB. */
    @Test
    void stubbornSets_ofALargeNet_areMadeFromItsArcs() {
        var row = PetriNet.builder("row").place("p0", 1);
        for (var i = 1; i <= 2000; i++) {
            row.place("p" + i).transition("t" + i, List.of("p" + (i - 1)), List.of("p" + i));
        }
        var net = row.build();

        assertThat(allocated(() -> new StubbornSets(net))).isLessThan(20 << 20);
        assertThat(DeadlockSearch.run(net).visitedMarkings()).isEqualTo(2001);
    }

    @Test
    void circles_thatIgnoreEachOther_areOpenedUntilAllTransitionsAreLive() {
        var net = circles(3, 4);

        assertThat(DeadlockSearch.run(net).visitedMarkings()).isEqualTo(4);
        var search = ProgressSearch.run(net, LIMITS);

        assertThat(search.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(search.losses()).isEmpty();
        assertThat(net.transitions()).allMatch(t -> search.live(t) == Verdict.YES);
        assertThat(search.toString()).endsWith("all transitions are live");
    }

    @Test
    void lossBesideACircle_isFound() {
        var onAndOff = net("switch", "on=1 off", "work: on > on", "stop: on > off");
        var net = circles(1, 3).toBuilder().add(onAndOff).build();

        var search = ProgressSearch.run(net, LIMITS);

        assertThat(search.losses()).singleElement().satisfies(loss -> {
            assertThat(loss.lost()).extracting(Transition::name).containsExactlyInAnyOrder("work", "stop");
            assertThat(net.fire(net.initialMarking(), loss.trace())).isEqualTo(loss.marking());
        });
        assertThat(search.live(net.transition("work"))).isEqualTo(Verdict.NO);
        assertThat(search.live(net.transition("t0.0"))).isEqualTo(Verdict.YES);
    }

    @Test
    void progressSearch_thatEndsEarly_knowsNothing() {
        var net = PaperNets.corrected(Reading.A);

        var search = ProgressSearch.run(net, SearchLimits.markings(10));
        var cancelled = ProgressSearch.run(net, LIMITS.cancelledBy(() -> true));

        assertThat(search.end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(search.live(net.transition("Tstop"))).isEqualTo(Verdict.UNKNOWN);
        assertThat(search).hasToString("corrected A: 10 markings visited, stopped at the limit");
        assertThat(cancelled.end()).isEqualTo(SearchEnd.CANCELLED);
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 2, 3, 6})
    void teams_areLiveIfTheyStopTogether_otherwiseLoseTheRegistrationOnly(int robots) {
        var together = ProgressSearch.run(RobotTeams.stoppingTogether(robots), LIMITS);
        var oneByOne = ProgressSearch.run(RobotTeams.stoppingOneByOne(robots), LIMITS);

        assertThat(together.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(together.losses()).isEmpty();
        assertThat(oneByOne.losses())
                .singleElement()
                .satisfies(loss -> assertThat(loss.lost())
                        .extracting(Transition::name)
                        .containsExactlyInAnyOrder("Tm1", "Ts1''", "Tms1''", "Tms2''"));
    }

    /**
     * For any net: the same dead markings as the full graph, with shortest traces that lead to them, and the lost
     * transitions of its terminal components.
     */
    @Test
    void searches_ofRandomNets_findWhatTheFullGraphShows() {
        var compared = 0;
        var reduced = 0;
        var withDead = 0;
        var progressReduced = 0;
        var partial = 0;
        for (var seed = 1L; seed <= 2000; seed++) {
            var net = Nets.any(new Random(seed));
            var limits = SearchLimits.markings(3000);
            var graph = ReachabilityGraph.explore(net, limits);
            if (!graph.isComplete()) {
                continue;
            }
            var search = DeadlockSearch.run(net, limits);
            var progress = ProgressSearch.run(net, limits);
            var expected = Liveness.of(graph).terminalComponents().stream()
                    .map(component -> Set.copyOf(component.neverFired()))
                    .filter(lost -> !lost.isEmpty())
                    .collect(toSet());
            var all = net.transitions().size();
            compared++;
            reduced += search.visitedMarkings() < graph.size() ? 1 : 0;
            withDead += graph.dead().isEmpty() ? 0 : 1;
            progressReduced += progress.visitedMarkings() < graph.size() ? 1 : 0;
            partial += expected.stream().anyMatch(lost -> lost.size() < all) ? 1 : 0;

            assertThat(List.of(search.end(), progress.end()))
                    .as("seed %d", seed)
                    .containsOnly(SearchEnd.COMPLETE);
            assertThat(search.deadlocks())
                    .as("seed %d", seed)
                    .extracting(DeadlockSearch.Deadlock::marking)
                    .containsExactlyInAnyOrderElementsOf(deadMarkings(graph));
            for (var dead : search.deadlocks()) {
                var nearest = graph.find(dead.marking()).orElseThrow();
                assertThat(dead.trace()).as("seed %d", seed).hasSameSizeAs(nearest.shortestTrace());
                assertThat(net.fire(net.initialMarking(), dead.trace())).isEqualTo(dead.marking());
            }
            assertThat(progress.losses().stream()
                            .map(loss -> Set.copyOf(loss.lost()))
                            .collect(toSet()))
                    .as("losses of seed %d", seed)
                    .isEqualTo(expected);
        }
        assertThat(compared).isGreaterThan(1500);
        assertThat(reduced).isGreaterThan(500);
        assertThat(withDead).isGreaterThan(500);
        assertThat(progressReduced).as("smaller").isGreaterThan(300);
        assertThat(partial).as("with a partial loss").isGreaterThan(100);
    }
}
