package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;
import static org.assertj.core.api.Assertions.assertThatIllegalStateException;

import io.troupe.petri.PaperNets.Reading;
import java.util.ArrayList;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.Test;

class SearchLimitsTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(10_000);

    @Test
    void report_isCalledAfterEachStepWithGrowingNumbers() {
        var reports = new ArrayList<SearchProgress>();

        var graph = ReachabilityGraph.explore(PaperNets.uncorrected(Reading.A), LIMITS.reporting(500, reports::add));

        assertThat(reports).extracting(SearchProgress::expanded).containsExactly(500, 1000);
        assertThat(reports).isSortedAccordingTo((a, b) -> Integer.compare(a.markings(), b.markings()));
        assertThat(reports)
                .allMatch(progress -> progress.markings() > progress.expanded()
                        && progress.edges() > progress.expanded()
                        && progress.dead() <= 6);
        assertThat(graph.end()).isEqualTo(SearchEnd.COMPLETE);
    }

    @Test
    void search_cancelledOnTheWay_tellsOnlyWhatItSaw() {
        var net = PaperNets.uncorrected(Reading.A);
        var cancel = new AtomicBoolean();
        var whole = ReachabilityGraph.explore(net);

        var part = ReachabilityGraph.explore(
                net, LIMITS.cancelledBy(cancel::get).reporting(50, progress -> cancel.set(true)));

        assertThat(part.end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(part.isComplete()).isFalse();
        assertThat(part.size()).isBetween(51, 1263);
        assertThat(part.openCount()).isEqualTo(part.size() - 50);
        assertThat(part.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(part.safe()).isEqualTo(Verdict.UNKNOWN);
        assertThat(part.summary())
                .startsWith("uncorrected A: cancelled at " + part.size() + " markings; " + part.openCount()
                        + " of them may have successors that were not visited\n");
        for (var state : part.states()) {
            var same = whole.find(state.marking()).orElseThrow();
            assertThat(state.shortestTrace()).isEqualTo(same.shortestTrace());
            assertThat(state.isOpen()).isEqualTo(state.index() >= 50);
            if (state.isOpen()) {
                assertThat(state.successors()).isEmpty();
            } else {
                assertThat(state.successors()).hasSameSizeAs(same.successors());
            }
            state.marking()
                    .marked()
                    .forEach(place -> assertThat(part.mostTokens(place)).isEqualTo(1));
        }
        var liveness = Liveness.of(part);
        assertThat(liveness.terminalComponents()).isEmpty();
        assertThat(liveness.live()).isEqualTo(Verdict.UNKNOWN);
    }

    @Test
    void search_cancelledBeforeItStarts_knowsTheInitialMarkingOnly() {
        var net = PaperNets.corrected(Reading.A);

        var graph = ReachabilityGraph.explore(net, LIMITS.cancelledBy(() -> true));

        assertThat(graph.states())
                .singleElement()
                .satisfies(state -> assertThat(state.marking()).isEqualTo(net.initialMarking()));
        assertThat(graph.mostTokens(net.place("R1"))).isEqualTo(1);
        assertThat(graph.end()).isEqualTo(SearchEnd.CANCELLED);
    }

    @Test
    void report_thatThrows_endsTheSearch() {
        var limits = LIMITS.reporting(10, progress -> {
            throw new IllegalStateException("no more at " + progress.expanded());
        });

        assertThatIllegalStateException()
                .isThrownBy(() -> ReachabilityGraph.explore(PaperNets.corrected(Reading.A), limits))
                .withMessage("no more at 10");
    }

    @Test
    void limits_outOfRange_areRefused() {
        assertThatIllegalArgumentException()
                .isThrownBy(() -> SearchLimits.markings(0))
                .withMessage("maxMarkings is 0, expected 1 or more");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> LIMITS.reporting(0, progress -> {}))
                .withMessage("markingsPerReport is 0, expected 1 or more");
    }
}
