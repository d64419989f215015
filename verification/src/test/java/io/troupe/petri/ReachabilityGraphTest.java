package io.troupe.petri;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalStateException;

import io.troupe.petri.PaperNets.Reading;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.Test;

/** The search of all markings, whole or ended by its limits, by its caller or for want of memory. */
class ReachabilityGraphTest {
    private static final PetriNet COUNTER = net("counter", "n", "up: > n");
    private static final SearchLimits LIMITS = SearchLimits.markings(10_000);

    /** n tokens that move one by one from a to b: n + 1 markings in a row. */
    private static PetriNet hourglass(int n) {
        return net("hourglass", "a=" + n + " b", "fall: a > b");
    }

    @Test
    void tokens_beyondOneBitPerPlace_areCountedExactly() {
        for (var n : List.of(1, 2, 3, 4, 15, 16, 255, 256, 70_000)) {
            var graph = ReachabilityGraph.explore(hourglass(n));

            assertThat(List.of(graph.size(), graph.edgeCount(), graph.mostTokens()))
                    .containsExactly(n + 1, n, n);
            assertThat(graph.dead()).singleElement().satisfies(state -> {
                assertThat(state.marking().tokens(graph.net().place("b"))).isEqualTo(n);
                assertThat(state.shortestTrace()).hasSize(n);
            });
        }
    }

    @Test
    void store_widenedOnTheWay_keepsWhatItFound() {
        var graph = ReachabilityGraph.explore(COUNTER, 1000);

        for (var state : graph.states()) {
            assertThat(state.marking().tokens(COUNTER.place("n"))).isEqualTo(state.index());
            assertThat(graph.find(state.marking())).contains(state);
        }
    }

    @Test
    void exploration_stoppedAtLimit_saysWhatIsKnownAndWhatIsNot() {
        var graph = ReachabilityGraph.explore(COUNTER, 100);

        assertThat(graph.isComplete()).isFalse();
        assertThat(graph.size()).isEqualTo(100);
        assertThat(graph.openCount()).isEqualTo(1);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(graph.summary()).isEqualTo("""
            counter: stopped at the limit of 100 markings; 1 of them have successors beyond it, which were not visited
              dead markings so far: 0; whether there are others is not known
              most tokens on a place so far: 99
              places never marked so far: []
              transitions never enabled so far: []\
            """);
        assertThat(graph.states().get(99).successors()).isEmpty();
        assertThat(graph.dead()).isEmpty();
    }

    @Test
    void exploration_limitThatFits_isComplete() {
        assertThat(ReachabilityGraph.explore(hourglass(9), 10).deadlockFree()).isEqualTo(Verdict.NO);
        assertThat(ReachabilityGraph.explore(hourglass(9), 10).isComplete()).isTrue();
        assertThat(ReachabilityGraph.explore(hourglass(9), 9).isComplete()).isFalse();
    }

    @Test
    void limits_outOfRange_areRefused() {
        refused(() -> ReachabilityGraph.explore(COUNTER, 0), "maxMarkings is 0, expected 1 or more");
        refused(() -> LIMITS.reporting(0, progress -> {}), "markingsPerReport is 0, expected 1 or more");
        refused(() -> LIMITS.within(0), "maxBytes is 0, expected 1 or more");
    }

    @Test
    void exploration_deadMarkingBelowLimit_isReportedThoughIncomplete() {
        var net = net("counter", "n idle=1 crashed", "up: > n", "crash: idle 2*n > crashed n");
        var mayStop = net("mayStop", "on=1 off n", "up: on > on n", "stop: on > off");

        assertThat(ReachabilityGraph.explore(net, 50).deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        var graph = ReachabilityGraph.explore(mayStop, 50);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.NO);
        assertThat(graph.isComplete()).isFalse();
        assertThat(graph.dead().get(0)).hasToString("{off}");
        assertThat(graph.dead().get(0).shortestTrace()).containsExactly(mayStop.transition("stop"));
    }

    @Test
    void deadPartsOfNet_areNamed() {
        var net = net("stuck", "a=1 b c", "ab: a > b", "bc: b a > c");

        var graph = ReachabilityGraph.explore(net);

        assertThat(graph.neverMarked()).containsExactly(net.place("c"));
        assertThat(graph.neverFired()).containsExactly(net.transition("bc"));
        assertThat(graph.mostTokens(net.place("b"))).isEqualTo(1);
        assertThat(graph.find(net.marking("c"))).isEmpty();
        assertThat(graph.find(net.marking("b", "b"))).isEmpty();
        assertThat(graph.summary()).isEqualTo("""
            stuck: 2 markings, 1 edges, all of them
              dead markings: 1, the nearest {b} after [ab]
              most tokens on a place: 1
              places never marked: [c]
              transitions never enabled: [bc]\
            """);
    }

    @Test
    void net_withoutPlacesOrTransitions_hasOneDeadMarking() {
        assertThat(ReachabilityGraph.explore(net("nothing", "")).dead()).hasSize(1);
    }

    @Test
    void report_isCalledAfterEachStepWithGrowingNumbers() {
        var reports = new ArrayList<SearchProgress>();

        var graph = ReachabilityGraph.explore(PaperNets.uncorrected(Reading.A), LIMITS.reporting(500, reports::add));

        assertThat(reports).extracting(SearchProgress::expanded).containsExactly(500, 1000);
        assertThat(reports)
                .isSortedAccordingTo(Comparator.comparingInt(SearchProgress::markings))
                .allMatch(progress -> progress.markings() > progress.expanded()
                        && progress.edges() > progress.expanded()
                        && progress.dead() <= 6);
        assertThat(graph.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThatIllegalStateException()
                .isThrownBy(() -> ReachabilityGraph.explore(graph.net(), LIMITS.reporting(10, progress -> {
                    throw new IllegalStateException("no more at " + progress.expanded());
                })))
                .withMessage("no more at 10");
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
            var successors = state.isOpen() ? 0 : same.successors().size();
            assertThat(state.successors()).hasSize(successors);
            assertThat(state.marking().marked()).allMatch(place -> part.mostTokens(place) == 1);
        }
        assertThat(Liveness.of(part).terminalComponents()).isEmpty();
        assertThat(Liveness.of(part).live()).isEqualTo(Verdict.UNKNOWN);
    }

    @Test
    void search_cancelledBeforeItStarts_knowsTheInitialMarkingOnly() {
        var net = PaperNets.corrected(Reading.A);

        var graph = ReachabilityGraph.explore(net, LIMITS.cancelledBy(() -> true));

        assertThat(graph.states()).extracting(ReachabilityGraph.State::marking).containsExactly(net.initialMarking());
        assertThat(graph.mostTokens(net.place("R1"))).isEqualTo(1);
        assertThat(graph.end()).isEqualTo(SearchEnd.CANCELLED);
    }

    @Test
    void search_atItsLimitOfMemory_tellsWhatItKnows() {
        var net = net("unbounded", "a=1 many", "t: a > a many");
        var limits = SearchLimits.markings(Integer.MAX_VALUE).within(4 << 20);

        var graph = ReachabilityGraph.explore(net, limits);

        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isGreaterThan(1000);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(graph.openCount()).isPositive();
        assertThat(graph.states().getLast().isOpen()).isTrue();
        assertThat(graph.summary()).startsWith("unbounded: out of memory at " + graph.size() + " markings; ");
        assertThat(Liveness.of(graph).live()).isEqualTo(Verdict.UNKNOWN);
        assertThat(DeadlockSearch.run(net, limits).toString()).endsWith("0 dead so far; out of memory");
    }

    /** Simulates a virtual machine without memory; the markings found so far are kept. */
    @Test
    void outOfMemoryError_endsTheSearchWithWhatItHas() {
        var net = Nets.switches(10);
        var rules = new FiringRules(net);
        Expansion failing = new Expansion() {
            private int asked;

            @Override
            public int choose(int[] tokens, int[] chosen) {
                if (++asked == 100) {
                    throw new OutOfMemoryError("Java heap space");
                }
                return rules.choose(tokens, chosen);
            }
        };

        var graph = ReachabilityGraph.explore(net, failing, LIMITS);

        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isGreaterThan(100);
        assertThat(graph.openCount()).isEqualTo(graph.size() - 99);
        assertThat(graph.states().get(98).successors()).isNotEmpty();
        assertThat(graph.states().get(99).successors()).isEmpty();
        assertThat(Liveness.of(graph).reversible()).isEqualTo(Verdict.UNKNOWN);
    }

    /** Random nets with weights, priorities and up to 90 places against a plain search over {@link PetriNet#fire}. */
    @Test
    void graph_ofRandomNets_agreesWithPlainSearch() {
        for (var seed = 1L; seed <= 150; seed++) {
            var as = "seed " + seed;
            var net = randomNet(new Random(seed));
            var limit = 150;
            var distances = plainSearch(net, limit + 1);
            var graph = ReachabilityGraph.explore(net, limit);

            assertThat(graph.isComplete()).as(as).isEqualTo(distances.size() <= limit);
            if (graph.isComplete()) {
                assertThat(graph.size()).as(as).isEqualTo(distances.size());
            }
            var fired = new HashSet<Transition>();
            var dead = new ArrayList<ReachabilityGraph.State>();
            for (var state : graph.states()) {
                var marking = state.marking();
                var trace = state.shortestTrace();
                assertThat(net.fire(net.initialMarking(), trace)).as(as).isEqualTo(marking);
                assertThat(trace).as(as).hasSize(distances.get(marking));
                var enabled = net.enabled(marking);
                fired.addAll(enabled);
                if (enabled.isEmpty()) {
                    dead.add(state);
                }
                var edges = state.successors();
                edges.forEach(edge -> assertThat(net.fire(marking, edge.transition()))
                        .as(as)
                        .isEqualTo(edge.target().marking()));
                if (graph.isComplete()) {
                    assertThat(edges)
                            .as(as)
                            .extracting(ReachabilityGraph.Edge::transition)
                            .isEqualTo(enabled);
                }
            }
            assertThat(graph.dead()).as(as).isEqualTo(dead);
            var neverFired = new ArrayList<>(net.transitions());
            neverFired.removeAll(fired);
            assertThat(graph.neverFired()).as(as).isEqualTo(neverFired);
        }
    }

    private static PetriNet randomNet(Random random) {
        var net = PetriNet.builder("random");
        var places = random.nextInt(10) == 0 ? 90 : 2 + random.nextInt(6);
        for (var p = 0; p < places; p++) {
            net.place("p" + p, random.nextInt(4) == 0 ? random.nextInt(5) : 0);
        }
        var transitions = 1 + random.nextInt(6);
        for (var t = 0; t < transitions; t++) {
            net.transition("t" + t).priority("t" + t, random.nextInt(5) == 0 ? 1 : 0);
            for (var p = 0; p < places; p++) {
                if (random.nextInt(Math.min(places, 8)) == 0) {
                    net.arc("p" + p, "t" + t, 1 + random.nextInt(2));
                }
                if (random.nextInt(Math.min(places, 8)) == 0) {
                    net.arc("t" + t, "p" + p, 1 + random.nextInt(2));
                }
            }
        }
        return net.build();
    }

    /** Up to {@code limit} markings with their distances from the initial one. */
    private static Map<Marking, Integer> plainSearch(PetriNet net, int limit) {
        var distances = new HashMap<>(Map.of(net.initialMarking(), 0));
        var queue = new ArrayDeque<>(List.of(net.initialMarking()));
        while (!queue.isEmpty()) {
            var marking = queue.remove();
            for (var transition : net.enabled(marking)) {
                var next = net.fire(marking, transition);
                if (distances.size() < limit && distances.putIfAbsent(next, distances.get(marking) + 1) == null) {
                    queue.add(next);
                }
            }
        }
        return distances;
    }
}
