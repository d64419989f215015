package io.troupe.petri.structure;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.Nets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Transition;
import io.troupe.petri.structure.DeadlockProof.Case;
import io.troupe.petri.structure.DeadlockProof.Contradiction;
import io.troupe.petri.structure.DeadlockProof.Disabled;
import io.troupe.petri.structure.DeadlockProof.Excluded;
import io.troupe.petri.structure.DeadlockProof.Halves;
import io.troupe.petri.structure.DeadlockProof.Reason;
import io.troupe.tools.Thorough;
import java.math.BigInteger;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.function.LongUnaryOperator;
import java.util.function.UnaryOperator;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Proofs by the state equation, compared with the full graph and checked by other code than that of the proofs. */
class DeadlockEquationTest {
    private static final long WORK = 20_000_000;
    private static final SearchLimits LIMITS = SearchLimits.markings(3000);

    private static Optional<DeadlockProof> solve(PetriNet net) {
        return DeadlockEquation.solve(net, WORK, () -> false, hint -> {});
    }

    private static PetriNet ring(int count, boolean leftHanded) {
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

    @ParameterizedTest
    @CsvSource({"2", "5", "20"})
    void philosophers_areProvedOnlyIfOneIsLeftHanded(int count) {
        var hint = new HashMap<Transition, Long>();
        assertThat(DeadlockEquation.solve(ring(count, false), WORK, () -> false, hint::putAll))
                .isEmpty();
        assertThat(hint).hasSize(count).allSatisfy((t, times) -> {
            assertThat(t.name()).startsWith("first");
            assertThat(times).isEqualTo(1);
        });
        var proof = solve(ring(count, true)).orElseThrow();
        assertThat(isProof(proof)).isTrue();
    }

    @Test
    void paperNets_areProvedOnlyIfCorrected() {
        var proof = solve(Nets.paper(Reading.A, true)).orElseThrow();
        assertThat(isProof(proof)).isTrue();
        assertThat(solve(Nets.paper(Reading.A, false))).isEmpty();
    }

    @Test
    void traps_excludeSolutionsThatCannotBeReached() {
        // by the equation, "less" could take the last token
        var net = net("trap", "a=3", "less: 2*a > a", "stay: a > a");
        var proof = solve(net).orElseThrow();
        assertThat(isProof(proof)).isTrue();
        assertThat(proof.traps()).isNotEmpty();
        assertThat(proof.toString()).startsWith("no dead marking satisfies the state equation: ");
    }

    @Test
    void inhibitorArcs_disableTransitions() {
        var running = net("running", "a=1 b", "go: a > b", "back: b > a");
        var stopped = running.toBuilder().inhibitor("b", "back", 1).build();
        assertThat(solve(running)).isPresent();
        assertThat(solve(stopped)).isEmpty();
        var never = running.toBuilder().inhibitor("b", "back", 2).build();
        assertThat(isProof(solve(never).orElseThrow())).isTrue();
    }

    @Test
    void search_endsAtItsLimits() {
        assertThat(solve(ring(5, true))).isPresent();
        assertThat(DeadlockEquation.solve(ring(5, true), WORK, () -> true, hint -> {}))
                .isEmpty();
        assertThat(DeadlockEquation.solve(ring(5, true), 1, () -> false, hint -> {}))
                .isEmpty();
    }

    /** The answers are those of the full graph, with inhibitor arcs, weights and priorities too. */
    @Test
    void answers_ofRandomNets_areThoseOfTheFullGraph() {
        var proved = 0;
        var open = 0;
        var missed = 0;
        for (var seed = 1L; seed <= Thorough.times(600, 6_000); seed++) {
            var random = new Random(31 * seed);
            var plain = seed % 3 == 0 ? Nets.sparse(seed, 2) : Nets.any(random);
            var net = seed % 2 == 0 ? Nets.inhibited(plain, random) : plain;
            var graph = ReachabilityGraph.explore(net, LIMITS);
            var found = solve(net);
            if (found.isPresent()) {
                proved++;
                assertThat(graph.dead()).as("seed %d", seed).isEmpty();
                assertThat(isProof(found.get())).as("seed %d", seed).isTrue();
            } else {
                open++;
                missed += graph.isComplete() && graph.dead().isEmpty() ? 1 : 0;
            }
        }
        assertThat(proved).as("proved").isGreaterThan(Thorough.times(75, 1_500));
        assertThat(open).as("not proved").isGreaterThan(Thorough.times(75, 1_500));
        assertThat(missed).as("not proved without a dead marking").isLessThan(open / 20);
    }

    /** A proof with another number, or with another case, is refused, unless the other checker accepts it too. */
    @Test
    void changedProofs_areRefused() {
        var refused = 0;
        var accepted = 0;
        for (var seed = 1L; seed <= Thorough.times(300, 3_000); seed++) {
            var random = new Random(17 * seed);
            var plain = seed % 3 == 0 ? Nets.sparse(seed, 2) : Nets.any(random);
            var net = seed % 2 == 0 ? Nets.inhibited(plain, random) : plain;
            var found = solve(net);
            if (found.isEmpty() || leaves(found.get().root()).findAny().isEmpty()) {
                continue;
            }
            for (var i = 0; i < 5; i++) {
                var root = mutated(found.get().root(), net, random);
                var holds = new Checker(net, found.get().traps()).holds(root, List.of());
                boolean isAccepted;
                try {
                    new DeadlockProof(net, found.get().traps(), root);
                    isAccepted = true;
                } catch (IllegalArgumentException wrong) {
                    isAccepted = false;
                }
                assertThat(isAccepted).as("seed %d: %s", seed, root).isEqualTo(holds);
                refused += holds ? 0 : 1;
                accepted += holds ? 1 : 0;
            }
        }
        assertThat(refused).isGreaterThan(Thorough.times(75, 1_500));
        assertThat(accepted).as("changes that are harmless").isGreaterThan(Thorough.times(2, 50));
    }

    @Test
    void wrongProofs_areRefusedWithTheReason() {
        var net = net("wheel", "a=1 b", "go: a > b", "back: b > a");
        var a = net.place("a");
        var b = net.place("b");
        var both = new Contradiction(Map.of(a, 1L, b, 1L), Map.of());
        var t = net.transition("go");
        var good = new Disabled(
                t, List.of(new Reason(0, new Disabled(net.transition("back"), List.of(new Reason(0, both))))));
        new DeadlockProof(net, List.of(), good);
        refused(
                () -> new DeadlockProof(net, List.of(), both),
                "place a weighs 1 without a bound, expected 0 or less, as it can hold any number of tokens");
        refused(
                () -> new DeadlockProof(net, List.of(), new Disabled(t, List.of())),
                "transition go: expected one case for each of its 1 arcs");
        refused(
                () -> new DeadlockProof(net, List.of(), new Excluded(a)),
                "place a: its assumptions do not exclude each other");
        refused(
                () -> new DeadlockProof(net, List.of(), new Contradiction(Map.of(a, -1L), Map.of())),
                "transition back changes the weighted sum by -1, expected 0 or more");
        refused(
                () -> new DeadlockProof(net, List.of(), new Contradiction(Map.of(), Map.of())),
                "the weighted sum is at most 0 and at least 0, which is no contradiction");
        refused(
                () -> new DeadlockProof(net, List.of(PlaceSet.of(net, "a")), good),
                "{a} is not an initially marked trap of net wheel");
        var other = net("other", "x=1", "t: x >");
        assertThatThrownBy(() -> new DeadlockProof(
                        net, List.of(), new Disabled(other.transition("t"), List.of(new Reason(0, both)))))
                .hasMessage("transition t is not of net wheel");
    }

    /** The root with one change somewhere. */
    private static Case mutated(Case root, PetriNet net, Random random) {
        var leaves = leaves(root).toList();
        var chosen = leaves.get(random.nextInt(leaves.size()));
        var place = net.places().get(random.nextInt(net.places().size()));
        LongUnaryOperator step = value -> value + (random.nextBoolean() ? 1 : -1);
        var wrong = switch (chosen) {
            case Contradiction leaf
            when random.nextInt(4) > 0 && !leaf.weights().isEmpty() -> {
                var weights = new HashMap<>(leaf.weights());
                weights.merge(place, step.applyAsLong(0), Long::sum);
                yield new Contradiction(weights, leaf.trapWeights());
            }
            default -> new Excluded(place);
        };
        return replaced(root, leaf -> leaf == chosen ? wrong : leaf);
    }

    private static Stream<Case> leaves(Case root) {
        return switch (root) {
            case Disabled split -> split.reasons().stream().flatMap(reason -> leaves(reason.then()));
            case Halves split -> Stream.of(split.upToMost(), split.more()).flatMap(DeadlockEquationTest::leaves);
            case Contradiction leaf -> Stream.of(leaf);
            case Excluded leaf -> Stream.of(leaf);
        };
    }

    private static Case replaced(Case root, UnaryOperator<Case> change) {
        return switch (root) {
            case Disabled split ->
                new Disabled(
                        split.transition(),
                        split.reasons().stream()
                                .map(reason -> new Reason(reason.arc(), replaced(reason.then(), change)))
                                .toList());
            case Halves split ->
                new Halves(
                        split.place(),
                        split.most(),
                        replaced(split.upToMost(), change),
                        replaced(split.more(), change));
            default -> change.apply(root);
        };
    }

    private static boolean isProof(DeadlockProof proof) {
        return new Checker(proof.net(), proof.traps()).holds(proof.root(), List.of());
    }

    /** Checks a proof from the definitions, and keeps the assumptions as a list. */
    private record Checker(PetriNet net, List<PlaceSet> traps) {
        /** That a place holds at least, or at most, so many tokens. */
        private record Assumption(Place place, boolean isLeast, long tokens) {}

        private static List<Assumption> and(List<Assumption> known, Assumption more) {
            var all = new ArrayList<>(known);
            all.add(more);
            return all;
        }

        boolean holds(Case assumed, List<Assumption> known) {
            return switch (assumed) {
                case Disabled split -> holds(split, known);
                case Halves split ->
                    holds(split.upToMost(), and(known, new Assumption(split.place(), false, split.most())))
                            && holds(split.more(), and(known, new Assumption(split.place(), true, split.most() + 1)));
                case Excluded leaf ->
                    known.stream()
                            .filter(one -> one.place.equals(leaf.place()) && one.isLeast)
                            .anyMatch(one -> known.stream()
                                    .anyMatch(other -> other.place.equals(leaf.place())
                                            && !other.isLeast
                                            && other.tokens < one.tokens));
                case Contradiction leaf -> holds(leaf, known);
            };
        }

        private boolean holds(Disabled split, List<Assumption> known) {
            var t = split.transition();
            var inputs = t.inputs().size();
            var seen = new ArrayList<Integer>();
            var now = known;
            for (var reason : split.reasons()) {
                var isInput = reason.arc() < inputs;
                var arc =
                        isInput ? t.inputs().get(reason.arc()) : t.inhibitors().get(reason.arc() - inputs);
                var few = new Assumption(arc.place(), false, arc.weight() - 1);
                var enough = new Assumption(arc.place(), true, arc.weight());
                if (!holds(reason.then(), and(now, isInput ? few : enough))) {
                    return false;
                }
                now = and(now, isInput ? enough : few);
                seen.add(reason.arc());
            }
            return seen.stream().distinct().count() == inputs + t.inhibitors().size();
        }

        /** The sum over the markings, the traps and the assumptions: more than it can be. */
        private boolean holds(Contradiction leaf, List<Assumption> known) {
            for (var t : net.transitions()) {
                var change = BigInteger.ZERO;
                for (var place : leaf.weights().keySet()) {
                    var in = t.inputs().stream().filter(arc -> arc.place().equals(place));
                    var out = t.outputs().stream().filter(arc -> arc.place().equals(place));
                    var gain = out.mapToInt(arc -> arc.weight()).sum()
                            - in.mapToInt(arc -> arc.weight()).sum();
                    change = change.add(product(gain, leaf.weights().get(place)));
                }
                if (change.signum() < 0) {
                    return false;
                }
            }
            var gap = BigInteger.ZERO;
            for (var place : net.places()) {
                var weight = leaf.weights().getOrDefault(place, 0L);
                gap = gap.add(product(place.tokens(), weight));
                for (var trap : leaf.trapWeights().entrySet()) {
                    weight += traps.get(trap.getKey()).contains(place) ? trap.getValue() : 0;
                }
                var isLeast = weight <= 0;
                var bounds = known.stream()
                        .filter(one -> one.place.equals(place) && one.isLeast == isLeast)
                        .mapToLong(Assumption::tokens);
                var bound = isLeast ? bounds.reduce(0, Math::max) : bounds.reduce(Long.MAX_VALUE, Math::min);
                if (bound == Long.MAX_VALUE) {
                    return false;
                }
                gap = gap.subtract(product(bound, weight));
            }
            for (var weight : leaf.trapWeights().values()) {
                gap = gap.add(BigInteger.valueOf(weight));
            }
            return gap.signum() > 0 && leaf.trapWeights().values().stream().allMatch(weight -> weight > 0);
        }

        private static BigInteger product(long one, long other) {
            return BigInteger.valueOf(one).multiply(BigInteger.valueOf(other));
        }
    }
}
