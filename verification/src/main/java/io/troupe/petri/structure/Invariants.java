package io.troupe.petri.structure;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.BooleanSupplier;
import java.util.function.ToIntFunction;

/**
 * Minimal semi-positive invariants in integers. A place invariant weighs the places so that no firing changes the
 * weighted sum of tokens; a transition invariant gives firing counts that together change no marking.
 *
 * <p>A semi-positive invariant has weights of 0 or more, not all 0. It is minimal if its support contains the support
 * of no other, and its weights have no common divisor. Every other semi-positive invariant is a sum of minimal ones
 * times positive fractions. Only semi-positive invariants bound tokens and identify cycles; a basis of the null space
 * may need negative weights.
 *
 * <p><b>Threads.</b> Thread-safe.
 *
 * <p><b>Cost.</b> There can be exponentially many invariants, and the work can be much more than the result.
 *
 * <p><b>Errors.</b> A weight beyond a {@code long} throws {@link ArithmeticException}.
 *
 * <p><b>Source.</b> The method of Farkas, as refined by Martinez and Silva, A simple and fast algorithm to obtain all
 * invariants of a generalised Petri net (1982).
 */
public final class Invariants {
    /** The limit of {@link #ofPlaces(PetriNet)} and {@link #ofTransitions(PetriNet)}. */
    public static final int DEFAULT_MAX_ROWS = 5_000;

    private Invariants() {}

    /**
     * Invariants, largest support last.
     *
     * @param invariants each is minimal, even if the search ended early; only weights above 0 are included
     * @param isComplete whether these are all; if not, the search reached its limit or was cancelled, and there may be
     *     more
     */
    public record Found<T>(List<Map<T, Long>> invariants, boolean isComplete) {
        public Found {
            invariants = invariants.stream().map(Map::copyOf).toList();
        }
    }

    /**
     * Computes the P-invariants: in every reachable marking the weighted sum of the tokens is that of the initial
     * marking.
     */
    public static Found<Place> ofPlaces(PetriNet net) {
        return ofPlaces(net, DEFAULT_MAX_ROWS);
    }

    /** Computes the P-invariants, with at most {@code maxRows} (1 or more) intermediate combinations at a time. */
    public static Found<Place> ofPlaces(PetriNet net, int maxRows) {
        return ofPlaces(net, maxRows, () -> false);
    }

    /** Computes the P-invariants until {@code cancelled} is true; it is called often, on the calling thread. */
    public static Found<Place> ofPlaces(PetriNet net, int maxRows, BooleanSupplier cancelled) {
        var matrix = new IncidenceMatrix(net).onPlaces();
        var search = new SemiPositive(matrix, net.transitions().size(), cancelled);
        return find(search, net.places(), Place::index, maxRows);
    }

    /**
     * Computes the T-invariants: a firing sequence with these counts leads back to the marking it started from, if
     * there is such a sequence.
     */
    public static Found<Transition> ofTransitions(PetriNet net) {
        return ofTransitions(net, DEFAULT_MAX_ROWS);
    }

    /** Computes the T-invariants, with at most {@code maxRows} (1 or more) intermediate combinations at a time. */
    public static Found<Transition> ofTransitions(PetriNet net, int maxRows) {
        return ofTransitions(net, maxRows, () -> false);
    }

    /** Computes the T-invariants until {@code cancelled} is true; it is called often, on the calling thread. */
    public static Found<Transition> ofTransitions(PetriNet net, int maxRows, BooleanSupplier cancelled) {
        var matrix = new IncidenceMatrix(net).ofTransitions();
        var search = new SemiPositive(matrix, net.places().size(), cancelled);
        return find(search, net.transitions(), Transition::index, maxRows);
    }

    private static <T> Found<T> find(SemiPositive search, List<T> things, ToIntFunction<T> index, int maxRows) {
        if (maxRows < 1) {
            throw new IllegalArgumentException("maxRows is " + maxRows + ", expected 1 or more");
        }
        var complete = search.run(maxRows);
        var found = search.solutions().stream()
                .map(factors -> weights(factors, things, index))
                .sorted(Comparator.comparingInt(Map::size))
                .toList();
        return new Found<>(found, complete);
    }

    private static <T> Map<T, Long> weights(long[] factors, List<T> things, ToIntFunction<T> index) {
        Map<T, Long> weights = new HashMap<>();
        for (var thing : things) {
            var factor = factors[index.applyAsInt(thing)];
            if (factor != 0) {
                weights.put(thing, factor);
            }
        }
        return weights;
    }
}
