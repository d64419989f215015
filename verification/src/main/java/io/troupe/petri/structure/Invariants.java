package io.troupe.petri.structure;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.math.BigInteger;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
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
 * <p><b>Errors.</b> A weight of an invariant beyond a {@code long} throws {@link ArithmeticException}.
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

    private static <T> Map<T, Long> weights(BigInteger[] factors, List<T> things, ToIntFunction<T> index) {
        Map<T, Long> weights = new HashMap<>();
        for (var thing : things) {
            var factor = factors[index.applyAsInt(thing)].longValueExact();
            if (factor != 0) {
                weights.put(thing, factor);
            }
        }
        return weights;
    }

    /**
     * Computes all minimal semi-positive integer vectors x with x A = 0. It starts from the unit vectors and cancels
     * the columns of A one after the other by positive combinations of two rows. A row whose support contains that of
     * another row is dropped.
     */
    private static final class SemiPositive {
        /** A combination of the rows of A: its factors, and the remaining sum. */
        private record Row(BigInteger[] factors, BigInteger[] rest, BitSet support) {}

        private final int columns;
        private final BooleanSupplier cancelled;
        /** Whether the search was cancelled before all rows were added. */
        private boolean isCut;

        private List<Row> rows = new ArrayList<>();
        private final BitSet open = new BitSet();

        /** Takes the rows of A, each by column. */
        SemiPositive(List<Map<Integer, Long>> matrix, int columns, BooleanSupplier cancelled) {
            this.columns = columns;
            this.cancelled = cancelled;
            open.set(0, columns);
            for (var i = 0; i < matrix.size(); i++) {
                if (cancelled.getAsBoolean()) {
                    isCut = true;
                    return;
                }
                var factors = zeros(matrix.size());
                factors[i] = BigInteger.ONE;
                var rest = zeros(columns);
                matrix.get(i).forEach((column, value) -> rest[column] = BigInteger.valueOf(value));
                rows.add(row(factors, rest));
            }
        }

        private static BigInteger[] zeros(int count) {
            var zeros = new BigInteger[count];
            Arrays.fill(zeros, BigInteger.ZERO);
            return zeros;
        }

        /**
         * Computes the solutions. Returns false if it was cancelled or would need more than {@code maxRows}
         * combinations.
         */
        boolean run(int maxRows) {
            if (isCut) {
                return false;
            }
            while (!open.isEmpty()) {
                if (cancelled.getAsBoolean()) {
                    return false;
                }
                var column = cheapest();
                var next = new ArrayList<Row>();
                for (var row : rows) {
                    if (cancelled.getAsBoolean()) {
                        return false;
                    }
                    if (row.rest()[column].signum() == 0) {
                        addMinimal(next, row);
                    }
                }
                for (var plus : rows) {
                    if (cancelled.getAsBoolean()) {
                        return false;
                    }
                    for (var minus : rows) {
                        if (plus.rest()[column].signum() > 0 && minus.rest()[column].signum() < 0) {
                            addMinimal(next, cancel(plus, minus, column));
                            if (next.size() > maxRows) {
                                return false;
                            }
                        }
                    }
                }
                rows = next;
                open.clear(column);
            }
            return true;
        }

        /** The factors of the combinations that are 0 in all columns: all solutions, after a complete run. */
        List<BigInteger[]> solutions() {
            return rows.stream()
                    .filter(row -> Arrays.stream(row.rest()).allMatch(value -> value.signum() == 0))
                    .map(Row::factors)
                    .toList();
        }

        /** The column that adds the fewest rows when it is cancelled. */
        private int cheapest() {
            var best = -1;
            var least = Long.MAX_VALUE;
            for (var column = open.nextSetBit(0); column >= 0; column = open.nextSetBit(column + 1)) {
                var at = column;
                var plus =
                        rows.stream().filter(row -> row.rest()[at].signum() > 0).count();
                var minus =
                        rows.stream().filter(row -> row.rest()[at].signum() < 0).count();
                if (plus * minus - plus - minus < least) {
                    least = plus * minus - plus - minus;
                    best = column;
                }
            }
            return best;
        }

        private Row cancel(Row plus, Row minus, int column) {
            var timesPlus = minus.rest()[column].negate();
            var timesMinus = plus.rest()[column];
            return row(
                    combine(plus.factors(), timesPlus, minus.factors(), timesMinus),
                    combine(plus.rest(), timesPlus, minus.rest(), timesMinus));
        }

        private static BigInteger[] combine(
                BigInteger[] one, BigInteger times, BigInteger[] other, BigInteger otherTimes) {
            var sum = new BigInteger[one.length];
            for (var i = 0; i < sum.length; i++) {
                sum[i] = one[i].multiply(times).add(other[i].multiply(otherTimes));
            }
            return sum;
        }

        /** The row divided by the common divisor of its factors. */
        private Row row(BigInteger[] factors, BigInteger[] rest) {
            var divisor = BigInteger.ZERO;
            for (var factor : factors) {
                divisor = divisor.gcd(factor);
            }
            var support = new BitSet();
            for (var i = 0; i < factors.length; i++) {
                factors[i] = factors[i].divide(divisor);
                support.set(i, factors[i].signum() != 0);
            }
            for (var i = 0; i < columns; i++) {
                rest[i] = rest[i].divide(
                        divisor); // a combination of integer rows is divisible by what divides its factors
            }
            return new Row(factors, rest, support);
        }

        private static void addMinimal(List<Row> rows, Row row) {
            if (rows.stream().noneMatch(other -> Needs.isSubset(other.support(), row.support()))) {
                rows.removeIf(other -> Needs.isSubset(row.support(), other.support()));
                rows.add(row);
            }
        }
    }
}
