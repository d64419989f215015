package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.Arc;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.math.BigInteger;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * A proof that no reachable marking of a net is dead, by the state equation m = m0 + C s and marked traps.
 *
 * <p>The proof assumes a reachable dead marking. In it each transition lacks tokens on one of its input places, or has
 * them on a place that inhibits it; so the proof splits into these cases, again and again, until each case contradicts
 * the state equation.
 *
 * <p><b>Role.</b> Found by {@link DeadlockEquation}, in floating point. The constructor checks it in integers, so every
 * instance is a proof, however it was found. Priorities and inhibitor arcs only prevent firings, so it holds with them.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> The constructor takes time in proportion to the cases times the arcs.
 *
 * <p><b>Errors.</b> What is no proof throws {@link IllegalArgumentException}, with the reason.
 *
 * @param traps initially marked traps: each of them always holds a token
 * @param root the case without assumptions
 */
public record DeadlockProof(PetriNet net, List<PlaceSet> traps, Case root) {
    public DeadlockProof {
        requireNonNull(root, "root");
        traps = List.copyOf(traps);
        for (var trap : traps) {
            trap.requirePlacesOf(net);
            if (!Siphons.isTrap(trap) || !trap.isMarked(net.initialMarking())) {
                throw new IllegalArgumentException(trap + " is not an initially marked trap of net " + net.name());
            }
        }
        new Check(net, traps).check(root);
    }

    /** A case: assumptions that no reachable dead marking satisfies. */
    public sealed interface Case {}

    /**
     * One case for each reason why a transition is disabled. In each case the reasons before it in the list do not
     * apply.
     */
    public record Disabled(Transition transition, List<Reason> reasons) implements Case {
        public Disabled {
            requireNonNull(transition, "transition");
            reasons = List.copyOf(reasons);
        }
    }

    /**
     * A case in which one arc disables the transition: an input place holds fewer tokens than the arc needs, or a place
     * holds enough tokens to inhibit it.
     *
     * @param arc the position of the arc among the inputs and then the inhibitors of the transition
     */
    public record Reason(int arc, Case then) {
        public Reason {
            requireNonNull(then, "then");
        }
    }

    /** Two cases: the place holds {@code most} tokens or fewer, or it holds more. */
    public record Halves(Place place, long most, Case upToMost, Case more) implements Case {
        public Halves {
            requireNonNull(place, "place");
            requireNonNull(upToMost, "upToMost");
            requireNonNull(more, "more");
        }
    }

    /** The assumptions about this place exclude each other. */
    public record Excluded(Place place) implements Case {
        public Excluded {
            requireNonNull(place, "place");
        }
    }

    /**
     * The assumptions contradict the state equation. No firing lowers the sum of weight times tokens, so it is never
     * less than at first; each trap holds a token; but the assumptions bound the sum of both below that.
     *
     * @param weights of places, also negative; the others weigh 0
     * @param trapWeights of traps, by their position in the proof; 1 or more
     */
    public record Contradiction(Map<Place, Long> weights, Map<Integer, Long> trapWeights) implements Case {
        public Contradiction {
            weights = Map.copyOf(weights);
            trapWeights = Map.copyOf(trapWeights);
        }
    }

    /** The number of contradictions at the ends of the cases; the rest are excluded by the assumptions alone. */
    public int contradictions() {
        var count = 0;
        var open = new ArrayList<>(List.of(root));
        while (!open.isEmpty()) {
            switch (open.removeLast()) {
                case Contradiction leaf -> count++;
                case Disabled split -> split.reasons.forEach(reason -> open.add(reason.then));
                case Halves split -> open.addAll(List.of(split.upToMost, split.more));
                case Excluded leaf -> {}
            }
        }
        return count;
    }

    /** In a line: the number of cases and traps. */
    @Override
    public String toString() {
        return "no dead marking satisfies the state equation: " + contradictions() + " cases, " + traps.size()
                + " traps";
    }

    /** Goes through the cases with the assumptions that hold in each. */
    private static final class Check {
        private final PetriNet net;
        private final List<PlaceSet> traps;
        /** By place: the fewest and the most tokens that the assumptions allow; no most means any number. */
        private final long[] least;

        private final @Nullable Long[] most;

        Check(PetriNet net, List<PlaceSet> traps) {
            this.net = net;
            this.traps = traps;
            least = new long[net.places().size()];
            most = new Long[net.places().size()];
        }

        void check(Case assumed) {
            switch (assumed) {
                case Disabled split -> checkReasons(split);
                case Halves split -> {
                    requireOwn(split.place);
                    withMost(split.place, split.most, split.upToMost);
                    withLeast(split.place, split.most + 1L, split.more);
                }
                case Excluded leaf -> {
                    requireOwn(leaf.place);
                    var bound = most[leaf.place.index()];
                    if (bound == null || bound >= least[leaf.place.index()]) {
                        throw new IllegalArgumentException(
                                "place " + leaf.place + ": its assumptions do not exclude each other");
                    }
                }
                case Contradiction leaf -> checkContradiction(leaf);
            }
        }

        private void checkReasons(Disabled split) {
            var t = split.transition;
            if (t.index() >= net.transitions().size()
                    || !net.transitions().get(t.index()).equals(t)) {
                throw new IllegalArgumentException("transition " + t + " is not of net " + net.name());
            }
            var inputs = t.inputs().size();
            var arcs =
                    IntStream.range(0, inputs + t.inhibitors().size()).boxed().toList();
            if (!split.reasons.stream().map(Reason::arc).sorted().toList().equals(arcs)) {
                throw new IllegalArgumentException(
                        "transition " + t + ": expected one case for each of its " + arcs.size() + " arcs");
            }
            var leastBefore = least.clone();
            var mostBefore = most.clone();
            for (var reason : split.reasons) {
                var isInput = reason.arc < inputs;
                var arc = isInput ? t.inputs().get(reason.arc) : t.inhibitors().get(reason.arc - inputs);
                if (isInput) {
                    withMost(arc.place(), arc.weight() - 1L, reason.then);
                    raiseLeast(arc.place(), arc.weight());
                } else {
                    withLeast(arc.place(), arc.weight(), reason.then);
                    lowerMost(arc.place(), arc.weight() - 1L);
                }
            }
            System.arraycopy(leastBefore, 0, least, 0, least.length);
            System.arraycopy(mostBefore, 0, most, 0, most.length);
        }

        private void withMost(Place place, long bound, Case then) {
            var before = most[place.index()];
            lowerMost(place, bound);
            check(then);
            most[place.index()] = before;
        }

        private void lowerMost(Place place, long bound) {
            var before = most[place.index()];
            most[place.index()] = before == null ? bound : Math.min(before, bound);
        }

        private void withLeast(Place place, long bound, Case then) {
            var before = least[place.index()];
            raiseLeast(place, bound);
            check(then);
            least[place.index()] = before;
        }

        private void raiseLeast(Place place, long bound) {
            least[place.index()] = Math.max(least[place.index()], bound);
        }

        private void requireOwn(Place place) {
            PlaceSet.of(net, List.of(place));
        }

        private void checkContradiction(Contradiction leaf) {
            PlaceSet.of(net, leaf.weights.keySet());
            requireNoLoss(leaf.weights);
            Map<Place, BigInteger> sum = new HashMap<>();
            var atLeast = BigInteger.ZERO;
            for (var entry : leaf.weights.entrySet()) {
                var weight = BigInteger.valueOf(entry.getValue());
                sum.put(entry.getKey(), weight);
                atLeast = atLeast.add(
                        weight.multiply(BigInteger.valueOf(entry.getKey().tokens())));
            }
            for (var entry : leaf.trapWeights.entrySet()) {
                var weight = BigInteger.valueOf(entry.getValue());
                if (weight.signum() <= 0) {
                    throw new IllegalArgumentException("a trap weighs " + weight + ", expected 1 or more");
                }
                traps.get(entry.getKey()).places().forEach(place -> sum.merge(place, weight, BigInteger::add));
                atLeast = atLeast.add(weight);
            }
            var atMost = BigInteger.ZERO;
            for (var entry : sum.entrySet()) {
                atMost = atMost.add(mostOf(entry.getKey(), entry.getValue()));
            }
            if (atMost.compareTo(atLeast) >= 0) {
                throw new IllegalArgumentException("the weighted sum is at most " + atMost + " and at least " + atLeast
                        + ", which is no contradiction");
            }
        }

        private BigInteger mostOf(Place place, BigInteger weight) {
            if (weight.signum() <= 0) {
                return weight.multiply(BigInteger.valueOf(least[place.index()]));
            }
            var bound = most[place.index()];
            if (bound == null) {
                throw new IllegalArgumentException("place " + place + " weighs " + weight
                        + " without a bound, expected 0 or less, as it can hold any number of tokens");
            }
            return weight.multiply(BigInteger.valueOf(bound));
        }

        private void requireNoLoss(Map<Place, Long> weights) {
            for (var t : net.transitions()) {
                var change = weighted(t.outputs(), weights).subtract(weighted(t.inputs(), weights));
                if (change.signum() < 0) {
                    throw new IllegalArgumentException(
                            "transition " + t + " changes the weighted sum by " + change + ", expected 0 or more");
                }
            }
        }

        private static BigInteger weighted(List<Arc> arcs, Map<Place, Long> weights) {
            var sum = BigInteger.ZERO;
            for (var arc : arcs) {
                var weight = BigInteger.valueOf(weights.getOrDefault(arc.place(), 0L));
                sum = sum.add(weight.multiply(BigInteger.valueOf(arc.weight())));
            }
            return sum;
        }
    }
}
