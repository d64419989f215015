package io.troupe.petri.deadlock;

import static io.troupe.petri.Nets.net;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Answer;
import io.troupe.petri.Answer.No;
import io.troupe.petri.Answer.Unknown;
import io.troupe.petri.Answer.Yes;
import io.troupe.petri.DeadlockSearch.Deadlock;
import io.troupe.petri.Nets;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.TokenGame;
import io.troupe.petri.Transition;
import io.troupe.petri.deadlock.DeadlockCheck.Reduction;
import io.troupe.tools.Thorough;
import java.util.EnumMap;
import java.util.EnumSet;
import java.util.List;
import java.util.Random;
import java.util.Set;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The whole decision, and the reductions, hunts and proofs by themselves, compared with the full graph. */
class DeadlockCheckTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(3000);
    /** By place, from the third on: a change of the marking that leaves the fingerprints of {@link TokenGame} alone. */
    private static final List<Integer> SAME_PRINT =
            List.of(-1, 1, 2, 0, -4, 3, -1, 1, 1, 0, 1, 2, -1, 0, 1, 1, -1, -3, -1, 1, 1, 0, 0, 0, -1, 2);

    private static final Set<Reduction> RULES = EnumSet.complementOf(EnumSet.of(Reduction.EQUAL_PARTS));

    /**
     * Each philosopher takes the fork of the same number first; with {@code leftHanded} the last one takes it second.
     */
    private static PetriNet philosophers(int count, boolean leftHanded) {
        var net = PetriNet.builder("philosophers");
        for (var i = 0; i < count; i++) {
            net.place("thinks" + i, 1).place("holds" + i).place("eats" + i).place("fork" + i, 1);
        }
        for (var i = 0; i < count; i++) {
            var swaps = leftHanded && i == count - 1;
            var first = "fork" + (swaps ? (i + 1) % count : i);
            var second = "fork" + (swaps ? i : (i + 1) % count);
            net.transition("first" + i, List.of("thinks" + i, first), List.of("holds" + i));
            net.transition("second" + i, List.of("holds" + i, second), List.of("eats" + i));
            net.transition("put" + i, List.of("eats" + i), List.of("thinks" + i, first, second));
        }
        return net.build();
    }

    private static Deadlock dead(Answer<Deadlock> answer) {
        return ((No<Deadlock>) answer).counterexample();
    }

    private static boolean isDead(PetriNet net, List<Transition> trace) {
        return net.enabled(net.fire(net.initialMarking(), trace)).isEmpty();
    }

    @ParameterizedTest
    @CsvSource({"2", "5", "50", "300"})
    void philosophers_deadlockInOneFiringEach(int count) {
        var net = philosophers(count, false);
        var result = dead(DeadlockCheck.decide(net, SearchLimits.markings(1)));
        assertThat(result.trace()).hasSize(count);
        assertThat(result.marking().marked())
                .hasSize(count)
                .allMatch(place -> place.name().startsWith("holds"));
        assertThat(isDead(net, result.trace())).isTrue();
    }

    @ParameterizedTest
    @CsvSource({"2", "6"})
    void oneLeftHandedPhilosopher_preventsIt(int count) {
        var result = (Yes<Deadlock>) DeadlockCheck.decide(philosophers(count, true));
        assertThat(result.markings()).isLessThan(1000);
    }

    @Test
    void manyPhilosophers_withOneLeftHanded_areProvedWithoutASearch() {
        var net = philosophers(50, true);
        var result = DeadlockCheck.decide(net, SearchLimits.markings(1_000_000));
        assertThat(result).isInstanceOf(Yes.class);
        assertThat(((Yes<Deadlock>) result).markings()).isZero();
    }

    @Test
    void result_tellsWhyItIsNotKnown() {
        var net = philosophers(6, true);
        assertThat(DeadlockCheck.decide(net, Set.of(), SearchLimits.markings(10)))
                .isEqualTo(new Unknown<>(SearchEnd.LIMIT, 10));
        assertThat(DeadlockCheck.decide(net, LIMITS.cancelledBy(() -> true)))
                .isInstanceOfSatisfying(
                        Unknown.class, unknown -> assertThat(unknown.end()).isEqualTo(SearchEnd.CANCELLED));
        assertThat(DeadlockCheck.decide(net("free", "n", "up: > n")))
                .isEqualTo(new Yes<>("reductions leave a transition that needs no tokens", 0));
        assertThat(dead(DeadlockCheck.decide(net("still", "n"))).trace()).isEmpty();
    }

    /**
     * Every rule of the net alone and all together: the same verdict as the full graph, and traces that can be
     * translated.
     */
    @Test
    void reductions_ofRandomNets_keepWhetherTheyCanDeadlock() {
        var used = new EnumMap<Reduction, Integer>(Reduction.class);
        var smaller = 0;
        var dead = 0;
        for (var seed = 1L; seed <= Thorough.times(300, 3_000); seed++) {
            var random = new Random(seed);
            var plain = seed % 3 == 0 ? Nets.sparse(seed, 2) : Nets.any(random);
            var net = seed % 2 == 0 ? Nets.inhibited(plain, random) : plain;
            var graph = ReachabilityGraph.explore(net, LIMITS);
            if (!graph.isComplete()) {
                continue;
            }
            for (var rule : RULES) {
                used.merge(rule, compare(seed, net, graph, Set.of(rule)) ? 1 : 0, Integer::sum);
            }
            smaller += compare(seed, net, graph, RULES) ? 1 : 0;
            dead += graph.dead().isEmpty() ? 0 : 1;
        }
        assertThat(used).as("uses of the rules").hasSameSizeAs(RULES);
        assertThat(used.values()).as("%s", used).allMatch(count -> count > Thorough.times(3, 60));
        assertThat(smaller).isGreaterThan(Thorough.times(50, 1_000));
        assertThat(dead).isGreaterThan(Thorough.times(25, 500));
    }

    /** Whether the reduced net is smaller. */
    private static boolean compare(long seed, PetriNet net, ReachabilityGraph graph, Set<Reduction> rules) {
        var reduced = Reducer.reduce(net, rules, () -> false);
        var small = ReachabilityGraph.explore(reduced.net(), LIMITS);
        assertThat(small.dead().isEmpty())
                .as("seed %d, %s: %s", seed, rules, reduced.net())
                .isEqualTo(graph.dead().isEmpty());
        for (var state : small.dead().subList(0, Math.min(20, small.dead().size()))) {
            var trace =
                    state.shortestTrace().stream().mapToInt(Transition::index).toArray();
            assertThat(TraceShortener.leadsToDeadMarking(net, reduced.translate(trace)))
                    .as("seed %d, %s", seed, rules)
                    .isTrue();
        }
        return reduced.net().places().size() < net.places().size()
                || reduced.net().transitions().size() < net.transitions().size()
                || !reduced.net()
                        .initialMarking()
                        .toString()
                        .equals(net.initialMarking().toString());
    }

    @Test
    void paperNets_canDeadlock_withoutAnyOneRule() {
        var net = net(
                "two steps that need something more each",
                "a=1 b=1 x=1 u=1 p1 p5 y",
                "t0: a b > p1",
                "t2: p1 x > p5",
                "t3: p5 y > a b x u",
                "c1: u > y",
                "c2: u >");
        var found = dead(DeadlockCheck.decide(net));
        assertThat(found.marking()).hasToString("{p5}");
        assertThat(found.trace()).extracting(Transition::name).containsExactlyInAnyOrder("t0", "t2", "c2");
        for (var reading : PaperNets.Reading.values()) {
            for (var rule : RULES) {
                var rules = EnumSet.copyOf(RULES);
                rules.remove(rule);
                assertThat(DeadlockCheck.decide(PaperNets.uncorrected(reading), rules, LIMITS))
                        .as("%s without %s", reading, rule)
                        .isInstanceOf(No.class);
            }
        }
    }

    @Test
    void decisions_ofChainsOfAcquisitions_areThoseOfTheFullGraph() {
        var nets = Thorough.times(1_000, 20_000);
        var first = new Random().nextInt(1_000_000);
        var dead = 0;
        var proved = 0;
        for (var seed = first; seed < first + nets; seed++) {
            var net = Nets.chains(new Random(seed));
            var graph = ReachabilityGraph.explore(net, LIMITS);
            if (!graph.isComplete()) {
                continue;
            }
            dead += graph.dead().isEmpty() ? 0 : 1;
            proved += graph.dead().isEmpty() ? 1 : 0;
            compare(seed, net, graph, RULES);
            var result = DeadlockCheck.decide(net, LIMITS);
            if (graph.dead().isEmpty()) {
                assertThat(result).as("seed %d", seed).isInstanceOf(Yes.class);
            } else {
                assertThat(result).as("seed %d", seed).isInstanceOf(No.class);
                assertThat(isDead(net, dead(result).trace()))
                        .as("seed %d", seed)
                        .isTrue();
            }
        }
        assertThat(List.of(dead, proved))
                .as("can deadlock, cannot; seeds from %d", first)
                .allMatch(count -> count > nets / 20);
    }

    /** As if a reduction were wrong: traces of another net, which may be those of none. */
    @Test
    void traceOfTheReducedNet_thatLeadsToNoDeadMarking_isReplacedByASearchOfTheNetItself() {
        var net = net("two ways", "a=1 b c d", "left: a > b", "on: b > c", "back: c > a", "right: a > d");
        var other = net("other", "a=1 b c d", "left: a > b", "on: a > c", "back: a > d", "right: d > a");
        var free = net("free", "a=1 b", "turn: a > a", "left: a > a b", "on: b >", "back: b >");
        var found = dead(DeadlockCheck.decide(
                net, EnumSet.allOf(Reduction.class), LIMITS, rules -> Reducer.reduce(other, Set.of(), () -> false)));
        assertThat(found.trace()).extracting(Transition::name).containsExactly("right");
        assertThat(DeadlockCheck.decide(
                        free,
                        EnumSet.allOf(Reduction.class),
                        LIMITS,
                        rules -> Reducer.reduce(other, Set.of(), () -> false)))
                .as("a net without a dead marking")
                .isInstanceOf(Yes.class);
    }

    /** The marking after "turn" has the fingerprint of the one before it, but "turn" is no loop. */
    @Test
    void trace_throughMarkingsWithOneFingerprint_keepsTheFiringsBetweenThem() {
        var net =
                PetriNet.builder("crafted").place("go", 1).place("x").transition("turn", List.of("go"), List.of("go"));
        net.transition("end", List.of("go"), List.of());
        for (var p = 0; p < SAME_PRINT.size(); p++) {
            int change = SAME_PRINT.get(p);
            net.place("p" + p, Math.max(0, -change));
            if (change < 0) {
                net.arc("p" + p, "turn", -change);
            } else if (change > 0) {
                net.arc("turn", "p" + p, change).arc("p" + p, "end", change);
            }
        }
        var found = dead(DeadlockCheck.decide(net.build(), Set.of(), LIMITS));
        assertThat(found.trace()).extracting(Transition::name).containsExactly("turn", "end");
    }

    /** Weights whose sum is no int: the transitions stay apart. Both never fire, which the reduction does not see. */
    @Test
    void weights_thatCannotBeAdded_areNotFused() {
        var large = Integer.MAX_VALUE;
        var net = PetriNet.builder("large")
                .place("a", 1)
                .place("b")
                .place("c")
                .place("d")
                .place("e")
                .transition("left", List.of("a"), List.of("b"))
                .transition("right", List.of("a"), List.of("c"))
                .transition("one", List.of("b", "c"), List.of("d"))
                .transition("other", List.of("d"), List.of())
                .arc("one", "e", large)
                .arc("other", "e", large)
                .transition("end", List.of("e"), List.of())
                .build();
        assertThat(dead(DeadlockCheck.decide(net)).marking()).hasToString("{b}");
    }

    @Test
    void decisions_ofRandomNets_areThoseOfTheFullGraph() {
        var found = 0;
        var proved = 0;
        for (var seed = 1L; seed <= Thorough.times(150, 1_500); seed++) {
            var random = new Random(-seed);
            var net = seed % 2 == 0 ? Nets.inhibited(Nets.any(random), random) : Nets.any(random);
            var graph = ReachabilityGraph.explore(net, LIMITS);
            if (!graph.isComplete()) {
                continue;
            }
            switch (DeadlockCheck.decide(net, LIMITS)) {
                case No<Deadlock>(var dead) -> {
                    found++;
                    assertThat(isDead(net, dead.trace())).as("seed %d", seed).isTrue();
                    assertThat(net.fire(net.initialMarking(), dead.trace())).isEqualTo(dead.marking());
                    var nearest = graph.dead().getFirst().shortestTrace().size();
                    assertThat(dead.trace()).as("seed %d", seed).hasSizeGreaterThanOrEqualTo(nearest);
                }
                case Yes<Deadlock> proof -> {
                    proved++;
                    assertThat(graph.dead()).as("seed %d: %s", seed, proof).isEmpty();
                }
                case Unknown<Deadlock> unknown ->
                    assertThat(unknown).as("seed %d", seed).isNull();
            }
        }
        assertThat(found).isGreaterThan(Thorough.times(20, 400));
        assertThat(proved).isGreaterThan(Thorough.times(10, 200));
    }

    /** The same question with all rules, with none, and with each alone; also of nets with equal parts. */
    @Test
    void decisions_withEachRuleAlone_areThoseOfTheFullGraph() {
        var found = 0;
        var proved = 0;
        var byOrbits = 0;
        for (var seed = 1L; seed <= Thorough.times(120, 1_200); seed++) {
            var random = new Random(seed);
            var net = seed % 2 == 0 ? Nets.inhibited(Nets.any(random), random) : Nets.parts(2 + (int) seed % 3, random);
            var graph = ReachabilityGraph.explore(net, LIMITS);
            if (!graph.isComplete()) {
                continue;
            }
            found += graph.dead().isEmpty() ? 0 : 1;
            proved += graph.dead().isEmpty() ? 1 : 0;
            for (var rules : alternatives()) {
                switch (DeadlockCheck.decide(net, rules, LIMITS)) {
                    case No<Deadlock>(var dead) ->
                        assertThat(isDead(net, dead.trace()))
                                .as("seed %d, %s", seed, rules)
                                .isTrue();
                    case Yes<Deadlock> proof -> {
                        assertThat(graph.dead())
                                .as("seed %d, %s: %s", seed, rules, proof)
                                .isEmpty();
                        byOrbits += proof.proof().contains("equal parts") ? 1 : 0;
                    }
                    case Unknown<Deadlock> unknown ->
                        assertThat(unknown).as("seed %d, %s", seed, rules).isNull();
                }
            }
        }
        assertThat(List.of(found, proved, byOrbits))
                .as("can deadlock, cannot, proved by orbits")
                .allMatch(count -> count > Thorough.times(5, 100));
    }

    private static List<Set<Reduction>> alternatives() {
        return Stream.concat(
                        Stream.of(Set.<Reduction>of(), EnumSet.allOf(Reduction.class)),
                        Stream.of(Reduction.values()).map(Set::of))
                .toList();
    }

    /**
     * Each of n equal clients takes two of n + 1 units, one after the other: one of them can always take its second.
     * Neither the other rules nor the state equation reduce the markings to fewer than 2^n.
     */
    @ParameterizedTest
    @CsvSource({"3", "30"})
    void equalClients_areProvedByOrbits(int count) {
        var net = PetriNet.builder("units").place("units", count + 1);
        for (var i = 0; i < count; i++) {
            net.place("idle" + i, 1).place("one" + i).place("both" + i);
            net.transition("first" + i, List.of("idle" + i, "units"), List.of("one" + i));
            net.transition("second" + i, List.of("one" + i, "units"), List.of("both" + i));
            net.transition("back" + i, List.of("both" + i), List.of("idle" + i)).arc("back" + i, "units", 2);
        }
        assertThat(DeadlockCheck.decide(net.build(), SearchLimits.markings(100)))
                .isEqualTo(new Yes<>(
                        "of the reduced net, all orbits of markings (" + count + " equal parts) by stubborn sets",
                        count + 1));
    }
}
