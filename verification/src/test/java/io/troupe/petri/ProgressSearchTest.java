package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PaperNets.Reading;
import java.util.HashSet;
import java.util.List;
import java.util.Random;
import java.util.Set;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class ProgressSearchTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(100_000);

    /** Circles of {@code length} places, each with a token that moves round independently. */
    private static PetriNet circles(int count, int length) {
        var net = PetriNet.builder("circles");
        for (var c = 0; c < count; c++) {
            for (var i = 0; i < length; i++) {
                net.place("p" + c + "." + i, i == 0 ? 1 : 0);
            }
            for (var i = 0; i < length; i++) {
                net.transition(
                        "t" + c + "." + i, List.of("p" + c + "." + i), List.of("p" + c + "." + (i + 1) % length));
            }
        }
        return net.build();
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
        var net = circles(1, 3).toBuilder()
                .place("on", 1)
                .place("off")
                .transition("work", List.of("on"), List.of("on"))
                .transition("stop", List.of("on"), List.of("off"))
                .build();

        var search = ProgressSearch.run(net, LIMITS);

        assertThat(search.losses()).singleElement().satisfies(loss -> {
            assertThat(loss.lost()).extracting(Transition::name).containsExactlyInAnyOrder("work", "stop");
            assertThat(net.fire(net.initialMarking(), loss.trace())).isEqualTo(loss.marking());
        });
        assertThat(search.live(net.transition("work"))).isEqualTo(Verdict.NO);
        assertThat(search.live(net.transition("t0.0"))).isEqualTo(Verdict.YES);
    }

    @Test
    void search_thatEndsEarly_knowsNothing() {
        var net = PaperNets.corrected(Reading.A);

        var search = ProgressSearch.run(net, SearchLimits.markings(10));
        var cancelled = ProgressSearch.run(net, LIMITS.cancelledBy(() -> true));

        assertThat(search.end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(search.live(net.transition("Tstop"))).isEqualTo(Verdict.UNKNOWN);
        assertThat(search).hasToString("corrected A: 10 markings visited, stopped at the limit");
        assertThat(cancelled.end()).isEqualTo(SearchEnd.CANCELLED);
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 3, 6})
    void teamsThatStopTogether_areLive(int robots) {
        var search = ProgressSearch.run(RobotTeams.stoppingTogether(robots), LIMITS);

        assertThat(search.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(search.losses()).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 2, 6})
    void teamsThatStopOneByOne_loseTheRegistrationOnly(int robots) {
        var search = ProgressSearch.run(RobotTeams.stoppingOneByOne(robots), LIMITS);

        assertThat(search.losses())
                .singleElement()
                .satisfies(loss -> assertThat(loss.lost())
                        .extracting(Transition::name)
                        .containsExactlyInAnyOrder("Tm1", "Ts1''", "Tms1''", "Tms2''"));
    }

    /** For any net: the terminal components of the full graph lose the same transitions. */
    @Test
    void search_ofRandomNets_losesWhatTheFullGraphLoses() {
        var compared = 0;
        var reduced = 0;
        var partial = 0;
        for (var seed = 1L; seed <= 2000; seed++) {
            var net = RandomNets.any(new Random(seed));
            var graph = ReachabilityGraph.explore(net, 3000);
            if (!graph.isComplete()) {
                continue;
            }
            var search = ProgressSearch.run(net, SearchLimits.markings(3000));
            Set<Set<Transition>> expected = Liveness.of(graph).terminalComponents().stream()
                    .map(component -> Set.copyOf(component.neverFired()))
                    .filter(lost -> !lost.isEmpty())
                    .collect(Collectors.toSet());
            var actual = new HashSet<Set<Transition>>();
            search.losses().forEach(loss -> actual.add(Set.copyOf(loss.lost())));
            var all = net.transitions().size();
            compared++;
            reduced += search.visitedMarkings() < graph.size() ? 1 : 0;
            partial += expected.stream().anyMatch(lost -> lost.size() < all) ? 1 : 0;

            assertThat(search.end()).as("seed %d", seed).isEqualTo(SearchEnd.COMPLETE);
            assertThat(actual).as("seed %d", seed).isEqualTo(expected);
        }
        assertThat(compared).isGreaterThan(1500);
        assertThat(reduced).as("smaller").isGreaterThan(300);
        assertThat(partial).as("with a partial loss").isGreaterThan(100);
    }
}
