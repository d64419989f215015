package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.jupiter.api.Test;

class ReachabilityGraphTest {
    /** n tokens that move one by one from a to b: n + 1 markings in a row. */
    private static PetriNet hourglass(int n) {
        return PetriNet.builder("hourglass")
                .place("a", n)
                .place("b")
                .transition("fall", List.of("a"), List.of("b"))
                .build();
    }

    private static PetriNet counter() {
        return PetriNet.builder("counter")
                .place("n")
                .transition("up", List.of(), List.of("n"))
                .build();
    }

    @Test
    void tokens_beyondOneBitPerPlace_areCountedExactly() {
        for (var n : List.of(1, 2, 3, 4, 15, 16, 255, 256, 70_000)) {
            var graph = ReachabilityGraph.explore(hourglass(n));

            assertThat(graph.size()).isEqualTo(n + 1);
            assertThat(graph.edgeCount()).isEqualTo(n);
            assertThat(graph.mostTokens()).isEqualTo(n);
            assertThat(graph.dead()).singleElement().satisfies(state -> {
                assertThat(state.marking().tokens(graph.net().place("b"))).isEqualTo(n);
                assertThat(state.shortestTrace()).hasSize(n);
            });
        }
    }

    @Test
    void store_widenedOnTheWay_keepsWhatItFound() {
        var net = counter();

        var graph = ReachabilityGraph.explore(net, 1000);

        for (var state : graph.states()) {
            assertThat(state.marking().tokens(net.place("n"))).isEqualTo(state.index());
            assertThat(graph.find(state.marking())).contains(state);
        }
    }

    @Test
    void exploration_stoppedAtLimit_saysWhatIsKnownAndWhatIsNot() {
        var graph = ReachabilityGraph.explore(counter(), 100);

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
        assertThatIllegalArgumentException()
                .isThrownBy(() -> ReachabilityGraph.explore(hourglass(9), 0))
                .withMessage("maxMarkings is 0, expected 1 or more");
    }

    @Test
    void exploration_deadMarkingBelowLimit_isReportedThoughIncomplete() {
        var net = counter().toBuilder()
                .place("idle", 1)
                .place("crashed")
                .transition("crash", List.of("idle"), List.of("crashed"))
                .arc("crash", "n")
                .arc("n", "crash", 2)
                .build();
        var mayStop = PetriNet.builder("mayStop")
                .place("on", 1)
                .place("off")
                .place("n")
                .transition("up", List.of("on"), List.of("on", "n"))
                .transition("stop", List.of("on"), List.of("off"))
                .build();

        assertThat(ReachabilityGraph.explore(net, 50).deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        var graph = ReachabilityGraph.explore(mayStop, 50);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.NO);
        assertThat(graph.isComplete()).isFalse();
        assertThat(graph.dead().get(0)).hasToString("{off}");
        assertThat(graph.dead().get(0).shortestTrace()).containsExactly(mayStop.transition("stop"));
    }

    @Test
    void deadPartsOfNet_areNamed() {
        var net = PetriNet.builder("stuck")
                .place("a", 1)
                .place("b")
                .place("c")
                .transition("ab", List.of("a"), List.of("b"))
                .transition("bc", List.of("b"), List.of("c"))
                .arc("a", "bc")
                .build();

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
        assertThat(ReachabilityGraph.explore(PetriNet.builder("nothing").build())
                        .dead())
                .hasSize(1);
    }

    /** Random nets with weights, priorities and up to 90 places against a plain search over {@link PetriNet#fire}. */
    @Test
    void graph_ofRandomNets_agreesWithPlainSearch() {
        for (var seed = 1L; seed <= 150; seed++) {
            var net = randomNet(new Random(seed));
            var limit = 150;
            var distances = plainSearch(net, limit + 1);
            var graph = ReachabilityGraph.explore(net, limit);

            assertThat(graph.isComplete()).as("seed %d", seed).isEqualTo(distances.size() <= limit);
            if (graph.isComplete()) {
                assertThat(graph.size()).as("seed %d", seed).isEqualTo(distances.size());
            }
            var fired = new HashSet<Transition>();
            var dead = new ArrayList<ReachabilityGraph.State>();
            for (var state : graph.states()) {
                var marking = state.marking();
                assertThat(net.fire(net.initialMarking(), state.shortestTrace()))
                        .as("seed %d", seed)
                        .isEqualTo(marking);
                assertThat(distances.get(marking))
                        .as("seed %d", seed)
                        .isEqualTo(state.shortestTrace().size());
                var enabled = net.enabled(marking);
                fired.addAll(enabled);
                if (enabled.isEmpty()) {
                    dead.add(state);
                }
                var edges = state.successors();
                edges.forEach(edge -> assertThat(net.fire(marking, edge.transition()))
                        .isEqualTo(edge.target().marking()));
                if (graph.isComplete()) {
                    assertThat(edges)
                            .as("seed %d", seed)
                            .extracting(ReachabilityGraph.Edge::transition)
                            .isEqualTo(enabled);
                }
            }
            assertThat(graph.dead()).as("seed %d", seed).isEqualTo(dead);
            assertThat(graph.neverFired())
                    .as("seed %d", seed)
                    .isEqualTo(net.transitions().stream()
                            .filter(t -> !fired.contains(t))
                            .toList());
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
        var distances = new HashMap<Marking, Integer>();
        var queue = new ArrayDeque<Marking>();
        distances.put(net.initialMarking(), 0);
        queue.add(net.initialMarking());
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
