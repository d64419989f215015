package io.troupe.petri;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static java.util.stream.Collectors.joining;
import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.tools.Thorough;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Random;
import java.util.TreeMap;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Equal parts of nets: found or declared, checked, and searched by orbits, compared with all markings. */
class SymmetryTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(600);
    private static final int MOST_EXCHANGES = 200;

    /** Each of n clients asks, and is served alone. */
    private static PetriNet clients(int count) {
        var net = PetriNet.builder(count + " clients").place("free", 1);
        for (var i = 0; i < count; i++) {
            net.place("idle" + i, 1).place("asks" + i).place("served" + i);
        }
        for (var i = 0; i < count; i++) {
            net.transition("ask" + i, List.of("idle" + i), List.of("asks" + i));
            net.transition("begin" + i, List.of("asks" + i, "free"), List.of("served" + i));
            net.transition("end" + i, List.of("served" + i), List.of("idle" + i, "free"));
        }
        return net.build();
    }

    private static Symmetry.Group group(PetriNet net, String... blocks) {
        return new Symmetry.Group(Arrays.stream(blocks)
                .map(block -> Arrays.stream(block.split(" ")).map(net::place).toList())
                .toList());
    }

    @ParameterizedTest
    @ValueSource(ints = {2, 3, 10, 50})
    void equalClients_areFound_andCountedOnce(int count) {
        var net = clients(count);
        var symmetry = Symmetry.find(net);
        var graph = ReachabilityGraph.exploreMarkings(net, symmetry, LIMITS);
        assertThat(symmetry).hasToString(count + " equal parts");
        assertThat(symmetry.groups())
                .singleElement()
                .satisfies(group -> assertThat(group.blocks())
                        .hasSize(count)
                        .allSatisfy(block -> assertThat(block).hasSize(3)));
        // none or one is served; of the others any number asks
        assertThat(graph.size()).isEqualTo(count + 1 + count);
        assertThat(graph.toString())
                .isEqualTo(net.name() + ": " + graph.size() + " orbits of markings (" + count + " equal parts), "
                        + graph.edgeCount() + " edges, all of them");
        assertThat(List.of(graph.deadlockFree(), graph.safe())).containsOnly(Verdict.YES);
        assertThat(graph.neverFired()).isEmpty();
        assertThat(graph.neverMarked()).isEmpty();
    }

    /** The figures of an independent search with sorted robots; the service's two kinds of steps are equal too. */
    @ParameterizedTest
    @CsvSource({"2, 25344, 6016", "3, 344544, 52693"})
    void robotsOfThePaper_areEqual_withTheirPlayers(int robots, int uncorrected, int corrected) {
        var limits = SearchLimits.markings(1_000_000);
        for (var net : List.of(RobotTeams.uncorrected(robots), RobotTeams.stoppingTogether(robots))) {
            var found = Symmetry.find(net);
            assertThat(found).hasToString(robots + " equal parts and 2 equal parts");
            assertThat(found.groups().getLast().blocks())
                    .containsExactly(List.of(net.place("S8")), List.of(net.place("S9")));
            var ofRobots = Symmetry.of(net, found.groups().subList(0, 1));
            var isCorrected = net.name().startsWith("stopping");
            assertThat(ReachabilityGraph.exploreMarkings(net, ofRobots, limits).size())
                    .isEqualTo(isCorrected ? corrected : uncorrected);
            assertThat(DeadlockSearch.run(net, found, limits).deadlockFree())
                    .isEqualTo(isCorrected ? Verdict.YES : Verdict.NO);
        }
    }

    /** Turns of a ring are no exchanges of two parts, and neither is half of a ring for the other one. */
    @ParameterizedTest
    @ValueSource(ints = {3, 4, 7, 20})
    void ring_hasNoEqualParts(int count) {
        var ring = PetriNet.builder("ring");
        for (var i = 0; i < count; i++) {
            ring.place("waits" + i, 1).place("holds" + i).place("fork" + i, 1);
        }
        for (var i = 0; i < count; i++) {
            ring.transition("take" + i, List.of("waits" + i, "fork" + i), List.of("holds" + i));
            ring.transition(
                    "put" + i,
                    List.of("holds" + i, "fork" + (i + 1) % count),
                    List.of("waits" + i, "fork" + i, "fork" + (i + 1) % count));
        }
        var net = ring.build();
        assertThat(Symmetry.find(net).isTrivial()).isTrue();
        refused(
                () -> Symmetry.of(net, List.of(group(net, "waits0 holds0 fork0", "waits1 holds1 fork1"))),
                "net ring: blocks [waits0, holds0, fork0] and [waits1, holds1, fork1] are not equal: transition put0 has"
                        + " no counterpart");
    }

    /** Each of these differs from equal clients by one thing. */
    @Test
    void partsThatOnlyLookEqual_areRefused() {
        var clients = clients(2);
        var blocks = List.of("idle0 asks0 served0", "idle1 asks1 served1");
        var weight = clients.toBuilder().arc("end1", "asks0").build();
        var inhibited = clients.toBuilder().inhibitor("served1", "ask0").build();
        var urgent = clients.toBuilder().priority("begin1", 1).build();
        var more = net("more", "a=1 b=2", "ta: a >", "tb: b >");
        var heavy = net("heavy", "a=2 b=2", "ta: a >", "tb: 2*b >");
        var twice = net("twice", "a=1 b=1", "ta: a >", "tb: b >", "again: b >");
        for (var net : List.of(weight, inhibited, urgent, more, heavy, twice)) {
            assertThat(Symmetry.find(net).isTrivial()).as(net.toString()).isTrue();
        }
        for (var net : List.of(weight, inhibited, urgent)) {
            assertThat(Nets.refusals(() -> Symmetry.of(net, List.of(group(net, blocks.get(0), blocks.get(1))))))
                    .startsWith("net 2 clients: blocks [idle0, asks0, served0] and [idle1, asks1, served1] are not"
                            + " equal: transition ")
                    .endsWith(" has no counterpart");
        }
        refused(
                () -> Symmetry.of(more, List.of(group(more, "a", "b"))),
                "net more: blocks [a] and [b] are not equal: place a holds 1 tokens, place b 2");
        for (var net : List.of(heavy, twice)) {
            assertThat(Nets.refusals(() -> Symmetry.of(net, List.of(group(net, "a", "b")))))
                    .contains("no counterpart");
        }
        assertThat(Symmetry.of(clients, List.of(group(clients, blocks.get(0), blocks.get(1)))))
                .hasToString("2 equal parts");
    }

    /** Equal colours everywhere, but a circle of six is not two circles of three. */
    @Test
    void partsWithEqualNeighbours_areNotAlwaysEqual() {
        var net = PetriNet.builder("circles");
        for (var i = 0; i < 12; i++) {
            net.place("p" + i, 1);
        }
        for (var i = 0; i < 6; i++) {
            net.transition("long" + i, List.of("p" + i), List.of("p" + (i + 1) % 6));
            net.transition("short" + i, List.of("p" + (6 + i)), List.of("p" + (6 + i / 3 * 3 + (i + 1) % 3)));
        }
        assertThat(Symmetry.find(net.build()).isTrivial()).isTrue();
    }

    @Test
    void blocksThatAreNone_areRefused() {
        var net = clients(3);
        refused(
                () -> Symmetry.of(net, List.of(group(net, "idle0 asks0"))),
                "net 3 clients: a group has 1 blocks, expected 2 or more");
        refused(
                () -> Symmetry.of(net, List.of(group(net, "idle0 asks0", "idle1"))),
                "net 3 clients: block [idle1] has 1 places, expected 2 as in the others of its group");
        refused(
                () -> Symmetry.of(net, List.of(group(net, "idle0", "idle1"), group(net, "idle2", "idle0"))),
                "net 3 clients: place idle0 is in two blocks, expected one");
        refused(
                () -> DeadlockSearch.run(clients(3), Symmetry.none(net), LIMITS),
                "the symmetry is of net 3 clients, expected one of net 3 clients");
        refused(
                () -> Liveness.of(ReachabilityGraph.explore(net, Symmetry.find(net), LIMITS)),
                "the graph of net 3 clients has one marking of each orbit, expected one with all markings");
    }

    @Test
    void fixedPart_staysWhereItIs() {
        var net = clients(4);
        var symmetry = Symmetry.find(net).fixing(net.place("asks2"));
        assertThat(symmetry).hasToString("3 equal parts");
        assertThat(symmetry.groups().getFirst().blocks()).noneMatch(block -> block.contains(net.place("idle2")));
        assertThat(Symmetry.find(clients(2)).fixing(clients(2).place("idle0")).isTrivial())
                .isTrue();
        assertThat(symmetry.fixing(net.place("free"))).hasToString("3 equal parts");
    }

    /** All exchanges of equal parts, as the place that each place gets its tokens from. */
    private static List<List<Integer>> exchanges(Symmetry symmetry) {
        var places = symmetry.net().places().size();
        var all = List.of(IntStream.range(0, places).boxed().toList());
        for (var group : symmetry.groups()) {
            all = all.stream()
                    .flatMap(moves -> orders(group.blocks().size()).stream().map(order -> moved(moves, group, order)))
                    .toList();
        }
        return all;
    }

    private static List<Integer> moved(List<Integer> moves, Symmetry.Group group, List<Integer> order) {
        var moved = new ArrayList<>(moves);
        for (var i = 0; i < order.size(); i++) {
            for (var j = 0; j < group.blocks().get(i).size(); j++) {
                var from = group.blocks().get(order.get(i)).get(j).index();
                moved.set(group.blocks().get(i).get(j).index(), moves.get(from));
            }
        }
        return moved;
    }

    /** The marking of an orbit that is the first in alphabetical order, by trying all exchanges. */
    private static String first(Marking marking, List<List<Integer>> exchanges) {
        var tokens = marking.toArray();
        return exchanges.stream()
                .map(moves -> moves.stream().map(from -> tokens[from] + " ").collect(joining()))
                .min(Comparator.naturalOrder())
                .orElseThrow();
    }

    private static List<List<Integer>> orders(int count) {
        if (count == 0) {
            return List.of(List.of());
        }
        var all = new ArrayList<List<Integer>>();
        for (var shorter : orders(count - 1)) {
            for (var at = 0; at < count; at++) {
                var order = new ArrayList<>(shorter);
                order.add(at, count - 1);
                all.add(order);
            }
        }
        return all;
    }

    /** In how many ways the parts can be exchanged. */
    private static long orderOf(Symmetry symmetry) {
        return symmetry.groups().stream()
                .mapToLong(group -> factorial(group.blocks().size()))
                .reduce(1, (one, other) -> one * other);
    }

    private static long factorial(int n) {
        return n < 2 ? 1 : n * factorial(n - 1);
    }

    /**
     * Thousands of nets with 2 to 4 equal parts, shared places, steps of two parts, weights, inhibitor arcs and
     * priorities: as many orbits as all markings have, counted by trying all exchanges; the same bounds and distances;
     * and traces that fire.
     */
    @Test
    void orbits_ofRandomNets_areThoseOfAllMarkings() {
        var counts = new TreeMap<String, Integer>();
        for (var seed = 1L; seed <= Thorough.times(300, 3_000); seed++) {
            var random = new Random(seed);
            var parts = 2 + random.nextInt(3);
            var net = Nets.parts(parts, random);
            var whole = ReachabilityGraph.explore(net, LIMITS);
            var symmetry = Symmetry.find(net);
            counts.merge("missed parts", orderOf(symmetry) < factorial(parts) ? 1 : 0, Integer::sum);
            if (!whole.isComplete() || orderOf(symmetry) > MOST_EXCHANGES) {
                continue;
            }
            var graph = compare("seed " + seed, net, symmetry, whole);
            counts.merge("nets", 1, Integer::sum);
            counts.merge("smaller", graph.size() < whole.size() ? 1 : 0, Integer::sum);
            counts.merge("with dead markings", whole.dead().isEmpty() ? 0 : 1, Integer::sum);
            counts.merge("with inhibitor arcs", net.hasInhibitors() ? 1 : 0, Integer::sum);
            counts.merge("with priorities", net.isPrioritised() ? 1 : 0, Integer::sum);
            var search = DeadlockSearch.run(net, symmetry, LIMITS);
            counts.merge("smaller by stubborn sets", search.visitedMarkings() < graph.size() ? 1 : 0, Integer::sum);
        }
        assertThat(counts.remove("missed parts")).isLessThan(5);
        assertThat(counts)
                .hasSize(6)
                .allSatisfy((what, count) -> assertThat(count).as(what).isGreaterThan(Thorough.times(5, 100)));
        assertThat(counts.get("nets")).isGreaterThan(Thorough.times(75, 1_500));
    }

    /** The graph of orbits. */
    private static ReachabilityGraph compare(String as, PetriNet net, Symmetry symmetry, ReachabilityGraph whole) {
        var exchanges = exchanges(symmetry);
        var orbits = whole.states().stream()
                .map(state -> first(state.marking(), exchanges))
                .collect(toSet());
        var graph = ReachabilityGraph.exploreMarkings(net, symmetry, LIMITS);
        assertThat(graph.end()).as(as).isEqualTo(SearchEnd.COMPLETE);
        assertThat(graph.size()).as(as).isEqualTo(orbits.size());
        assertThat(graph.states().stream().map(state -> first(state.marking(), exchanges)))
                .as(as)
                .containsExactlyInAnyOrderElementsOf(orbits);
        for (var state : graph.states()) {
            requireShortest(as, state.marking(), state.shortestTrace(), whole);
            for (var edge : state.successors()) {
                assertThat(first(net.fire(state.marking(), edge.transition()), exchanges))
                        .as(as)
                        .isEqualTo(first(edge.target().marking(), exchanges));
            }
        }
        assertThat(graph.neverFired()).as(as).isEqualTo(whole.neverFired());
        assertThat(graph.neverMarked()).as(as).isEqualTo(whole.neverMarked());
        for (var place : net.places()) {
            assertThat(graph.mostTokens(place)).as(as).isEqualTo(whole.mostTokens(place));
        }
        var dead = whole.dead().stream()
                .map(state -> first(state.marking(), exchanges))
                .collect(toSet());
        var search = DeadlockSearch.run(net, symmetry, LIMITS);
        assertThat(search.deadlocks().stream().map(each -> first(each.marking(), exchanges)))
                .as(as)
                .containsExactlyInAnyOrderElementsOf(dead);
        search.deadlocks().forEach(each -> requireShortest(as, each.marking(), each.trace(), whole));
        var first = DeadlockSearch.first(net, symmetry, LIMITS);
        assertThat(first).as(as).isInstanceOf(dead.isEmpty() ? Answer.Yes.class : Answer.No.class);
        if (first instanceof Answer.No<DeadlockSearch.Deadlock>(var found)) {
            assertThat(net.fire(net.initialMarking(), found.trace())).as(as).isEqualTo(found.marking());
            assertThat(net.enabled(found.marking())).as(as).isEmpty();
        }
        return graph;
    }

    private static void requireShortest(String as, Marking marking, List<Transition> trace, ReachabilityGraph whole) {
        assertThat(whole.net().fire(whole.net().initialMarking(), trace)).as(as).isEqualTo(marking);
        assertThat(trace).as(as).hasSameSizeAs(whole.find(marking).orElseThrow().shortestTrace());
    }
}
