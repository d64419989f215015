package io.troupe.petri.structure;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.List;
import java.util.Map;
import java.util.function.BooleanSupplier;

/**
 * Computes all minimal semi-positive integer vectors x with x A = 0, by the method of Farkas, as refined by Martinez
 * and Silva. It starts from the unit vectors and cancels the columns of A one after the other by positive combinations
 * of two rows. A row whose support contains that of another row is dropped.
 */
final class SemiPositive {
    /** A combination of the rows of A: its factors, and the remaining sum. */
    private record Row(long[] factors, long[] rest, BitSet support) {}

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
            var factors = new long[matrix.size()];
            factors[i] = 1;
            var rest = new long[columns];
            matrix.get(i).forEach((column, value) -> rest[column] = value);
            rows.add(row(factors, rest));
        }
    }

    /**
     * Computes the solutions. Returns false if it was cancelled or would need more than {@code maxRows} combinations.
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
                if (row.rest()[column] == 0) {
                    addMinimal(next, row);
                }
            }
            for (var plus : rows) {
                if (cancelled.getAsBoolean()) {
                    return false;
                }
                for (var minus : rows) {
                    if (plus.rest()[column] > 0 && minus.rest()[column] < 0) {
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
    List<long[]> solutions() {
        return rows.stream()
                .filter(row -> Arrays.stream(row.rest()).allMatch(value -> value == 0))
                .map(Row::factors)
                .toList();
    }

    /** The column that adds the fewest rows when it is cancelled. */
    private int cheapest() {
        var best = -1;
        var least = Long.MAX_VALUE;
        for (var column = open.nextSetBit(0); column >= 0; column = open.nextSetBit(column + 1)) {
            var at = column;
            var plus = rows.stream().filter(row -> row.rest()[at] > 0).count();
            var minus = rows.stream().filter(row -> row.rest()[at] < 0).count();
            if (plus * minus - plus - minus < least) {
                least = plus * minus - plus - minus;
                best = column;
            }
        }
        return best;
    }

    private Row cancel(Row plus, Row minus, int column) {
        var timesPlus = Math.negateExact(minus.rest()[column]);
        var timesMinus = plus.rest()[column];
        return row(
                combine(plus.factors(), timesPlus, minus.factors(), timesMinus),
                combine(plus.rest(), timesPlus, minus.rest(), timesMinus));
    }

    private static long[] combine(long[] one, long times, long[] other, long otherTimes) {
        var sum = new long[one.length];
        for (var i = 0; i < sum.length; i++) {
            sum[i] = Math.addExact(Math.multiplyExact(one[i], times), Math.multiplyExact(other[i], otherTimes));
        }
        return sum;
    }

    /** The row divided by the common divisor of its factors. */
    private Row row(long[] factors, long[] rest) {
        var divisor = 0L;
        for (var factor : factors) {
            divisor = gcd(divisor, factor);
        }
        var support = new BitSet();
        for (var i = 0; i < factors.length; i++) {
            factors[i] /= divisor;
            support.set(i, factors[i] != 0);
        }
        for (var i = 0; i < columns; i++) {
            rest[i] /= divisor; // a combination of integer rows is divisible by what divides its factors
        }
        return new Row(factors, rest, support);
    }

    private static void addMinimal(List<Row> rows, Row row) {
        if (rows.stream().noneMatch(other -> Needs.isSubset(other.support(), row.support()))) {
            rows.removeIf(other -> Needs.isSubset(row.support(), other.support()));
            rows.add(row);
        }
    }

    private static long gcd(long a, long b) {
        return b == 0 ? Math.abs(a) : gcd(b, a % b);
    }
}
