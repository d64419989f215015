package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Bounds on tokens by a linear program over the state equation: markings m = m0 + C s with m and s not negative, where
 * C is the incidence matrix and s counts firings.
 *
 * <p>The program that is solved is the dual one: it weighs places so that no firing lowers the weighted sum, and a
 * place of the set weighs at most 1, another one at most 0. The largest initial sum of such weights is the fewest
 * tokens of the set, and the weights prove it.
 *
 * <p><b>Role.</b> Every reachable marking satisfies the equation, but not every solution m is reachable, and s need not
 * be integer. So a bound holds for all reachable markings, but need not be tight. Priorities only exclude markings, so
 * the bounds hold with them, too.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> One linear program for each bound.
 */
public final class StateEquation {
    private static final int MAX_SCALE = 1000;
    private static final double TOLERANCE = 1e-6;

    private final PetriNet net;
    private final List<Map<Integer, Long>> effects;

    public StateEquation(PetriNet net) {
        this.net = requireNonNull(net, "net");
        effects = IncidenceMatrix.of(net).stream().distinct().toList();
    }

    /**
     * The fewest tokens that the set holds in a marking of the state equation, as computed in floating point.
     *
     * <p>A value near 0 means that the state equation does not exclude an empty set. A larger value means that the set
     * is never empty, up to rounding errors; {@link #lowerBound} is the exact proof. Empty if there were too many
     * rounding errors.
     */
    public OptionalDouble leastTokens(PlaceSet set) {
        var weights = weights(set);
        return weights == null ? OptionalDouble.empty() : OptionalDouble.of(initialSum(weights));
    }

    /**
     * A proof that the set is never empty. Empty if the state equation does not exclude it, or if the solution was too
     * inaccurate for a proof in integers.
     */
    public Optional<TokenBound> lowerBound(PlaceSet set) {
        var weights = weights(set);
        if (weights == null || initialSum(weights) < TOLERANCE) {
            return Optional.empty();
        }
        return IntStream.rangeClosed(1, MAX_SCALE)
                .mapToObj(scale -> proof(set, weights, scale))
                .flatMap(Optional::stream)
                .findFirst();
    }

    /** By place, the best weights; the program has what each place lacks to the largest weight that it may have. */
    private double @Nullable [] weights(PlaceSet set) {
        set.requirePlacesOf(net);
        var places = net.places();
        var changes = new double[effects.size()][places.size()];
        var constants = new double[effects.size()];
        for (var row = 0; row < changes.length; row++) {
            for (var change : effects.get(row).entrySet()) {
                changes[row][change.getKey()] = -change.getValue();
                constants[row] += set.has(change.getKey()) ? change.getValue() : 0;
            }
        }
        var costs = places.stream().mapToDouble(Place::tokens).toArray();
        var simplex = new BoundedSimplex(changes, constants, costs);
        return simplex.solve() == BoundedSimplex.Outcome.SOLVED
                ? places.stream()
                        .mapToDouble(place -> (set.contains(place) ? 1 : 0) - simplex.value(place.index()))
                        .toArray()
                : null;
    }

    private double initialSum(double[] weights) {
        return net.places().stream()
                .mapToDouble(place -> weights[place.index()] * place.tokens())
                .sum();
    }

    /** The bound by the weights times scale, if these are integers up to rounding errors. */
    private Optional<TokenBound> proof(PlaceSet set, double[] weights, int scale) {
        Map<Place, Long> scaled = new HashMap<>();
        for (var place : net.places()) {
            var value = weights[place.index()] * scale;
            var rounded = Math.round(value);
            if (Math.abs(value - rounded) > TOLERANCE * Math.max(1, Math.abs(value))) {
                return Optional.empty();
            }
            if (rounded != 0) {
                scaled.put(place, rounded);
            }
        }
        try {
            return Optional.of(new TokenBound(set, scaled, scale)).filter(bound -> bound.tokens() > 0);
        } catch (IllegalArgumentException | ArithmeticException notQuite) {
            return Optional.empty(); // rounded to a wrong value; a larger scale may fit
        }
    }
}
