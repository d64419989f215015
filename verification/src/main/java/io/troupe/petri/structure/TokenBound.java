package io.troupe.petri.structure;

import io.troupe.petri.Place;
import java.util.Map;

/**
 * A proof that a set of places always holds a number of tokens.
 *
 * <p>No firing lowers the sum of weight times tokens, and {@code scale} times the tokens in the set are never less than
 * that sum. So the set always holds at least the initial sum divided by {@code scale}. The weights are the dual
 * solution of the linear program of {@link StateEquation}, in integers.
 *
 * <p><b>Cost.</b> The constructor checks the proof in time in proportion to the arcs.
 *
 * <p><b>Errors.</b> Weights that are no proof throw {@link IllegalArgumentException}: every instance is a proof in
 * exact arithmetic. A sum beyond a {@code long} throws {@link ArithmeticException}.
 *
 * @param weights of places of the net; the others weigh 0
 * @param scale 1 or more
 */
public record TokenBound(PlaceSet set, Map<Place, Long> weights, long scale) {
    public TokenBound {
        weights = Map.copyOf(weights);
        if (scale < 1) {
            throw new IllegalArgumentException("scale is " + scale + ", expected 1 or more");
        }
        PlaceSet.of(set.net(), weights.keySet());
        for (var weight : weights.entrySet()) {
            var most = set.contains(weight.getKey()) ? scale : 0;
            if (weight.getValue() > most) {
                throw new IllegalArgumentException("place " + weight.getKey() + " weighs " + weight.getValue()
                        + ", expected " + most + " or less for a bound on " + set);
            }
        }
        for (var t : set.net().transitions()) {
            var change = 0L;
            for (var arc : t.outputs()) {
                change = plus(change, arc.weight(), weights.getOrDefault(arc.place(), 0L));
            }
            for (var arc : t.inputs()) {
                change = plus(change, -arc.weight(), weights.getOrDefault(arc.place(), 0L));
            }
            if (change < 0) {
                throw new IllegalArgumentException(
                        "transition " + t + " changes the weighted sum by " + change + ", expected 0 or more");
            }
        }
    }

    private static long plus(long sum, int arcs, long weight) {
        return Math.addExact(sum, Math.multiplyExact((long) arcs, weight));
    }

    /** The lower bound of the set's tokens in every reachable marking; 0 or less proves nothing. */
    public long tokens() {
        var initial = 0L;
        for (var weight : weights.entrySet()) {
            initial = Math.addExact(initial, Math.multiplyExact(weight.getKey().tokens(), (long) weight.getValue()));
        }
        return Math.ceilDiv(initial, scale);
    }

    /** The set and the number of tokens. */
    @Override
    public String toString() {
        return set + " always holds " + tokens() + " or more tokens";
    }
}
