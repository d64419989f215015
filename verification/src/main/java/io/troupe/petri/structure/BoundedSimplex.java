package io.troupe.petri.structure;

import java.util.Arrays;
import java.util.OptionalInt;

/**
 * The dual simplex method for variables between bounds, in floating point. It keeps its tableau when bounds change, so
 * that a case that differs by one bound takes a few pivots.
 *
 * <p>Each basic variable is a linear function of the others, which stand at one of their bounds. The method minimises
 * the weighted sum of the first variables, whose weights are 0 or more: that keeps it going in one direction. A row
 * that cannot get within its bounds shows that there is no solution. Its coefficients are the multipliers of a proof,
 * which the caller must check in integers.
 */
final class BoundedSimplex {
    private static final double FEASIBLE = 1e-7;
    private static final double PIVOT = 1e-7;
    private static final double ZERO = 1e-11;
    private static final int MIN_PIVOTS = 2_000;
    private static final int PIVOTS_PER_ROW = 20;

    private double[] lower;
    private double[] upper;
    /** By row: its coefficients, by column. */
    private double[][] rows;

    /** By row: its variable, and the value. */
    private int[] basic;

    private double[] value;
    /** By column: its variable, whether it stands at its upper bound, and what one more of it costs. */
    private final int[] free;

    private final boolean[] isAtUpper;
    private final double[] cost;
    /** By variable: its row, or -1 minus its column. */
    private int[] home;

    private final int[] touched;
    private long work;

    /** What {@link #solve} found out. */
    enum Outcome {
        SOLVED,
        /** Some row cannot get within its bounds: {@link #stuckRow}. */
        INFEASIBLE,
        /** Too many pivots or rounding errors. */
        FAILED
    }

    private int stuckRow = -1;

    /**
     * Creates the tableau of {@code rows}. The variables are numbered: first one for each column, 0 or more, then one
     * for each row.
     *
     * @param rows by row: its coefficients, by column
     * @param constants by row: its value when all columns are 0
     * @param costs by column: what one more of it costs, 0 or more
     */
    BoundedSimplex(double[][] rows, double[] constants, double[] costs) {
        var columns = costs.length;
        this.rows = rows;
        value = constants;
        free = new int[columns];
        isAtUpper = new boolean[columns];
        cost = costs;
        touched = new int[columns];
        basic = new int[rows.length];
        home = new int[columns + rows.length];
        lower = new double[columns + rows.length];
        upper = new double[columns + rows.length];
        Arrays.fill(upper, Double.POSITIVE_INFINITY);
        for (var column = 0; column < columns; column++) {
            free[column] = column;
            home[column] = -1 - column;
        }
        for (var row = 0; row < rows.length; row++) {
            basic[row] = columns + row;
            home[columns + row] = row;
        }
    }

    /** A copy with separate bounds. */
    BoundedSimplex(BoundedSimplex other) {
        rows = new double[other.rows.length][];
        Arrays.setAll(rows, row -> other.rows[row].clone());
        value = other.value.clone();
        free = other.free.clone();
        isAtUpper = other.isAtUpper.clone();
        cost = other.cost.clone();
        touched = new int[free.length];
        basic = other.basic.clone();
        home = other.home.clone();
        lower = other.lower.clone();
        upper = other.upper.clone();
        work = (long) rows.length * free.length;
    }

    /** The additions and copies made so far: a measure of time that is the same in every run. */
    long work() {
        return work;
    }

    double lower(int variable) {
        return lower[variable];
    }

    double upper(int variable) {
        return upper[variable];
    }

    double value(int variable) {
        var at = home[variable];
        return at >= 0 ? value[at] : standing(-1 - at);
    }

    private double standing(int column) {
        return isAtUpper[column] ? upper[free[column]] : lower[free[column]];
    }

    void setLower(int variable, double bound) {
        setBound(variable, bound, lower, false);
    }

    void setUpper(int variable, double bound) {
        setBound(variable, bound, upper, true);
    }

    private void setBound(int variable, double bound, double[] bounds, boolean isUpper) {
        var before = bounds[variable];
        bounds[variable] = bound;
        var column = -1 - home[variable];
        if (column >= 0 && isAtUpper[column] == isUpper) {
            shift(column, bound - before);
        }
    }

    private void shift(int column, double by) {
        for (var row = 0; row < rows.length; row++) {
            value[row] += rows[row][column] * by;
        }
    }

    /** Adds a variable that is the sum of others, with a lower bound, and returns its number. */
    int addSum(int[] variables, double least) {
        var row = new double[free.length];
        var sum = 0.0;
        for (var variable : variables) {
            var at = home[variable];
            if (at >= 0) {
                for (var column = 0; column < row.length; column++) {
                    row[column] += rows[at][column];
                }
            } else {
                row[-1 - at]++;
            }
            sum += value(variable);
        }
        work += (long) row.length * variables.length;
        var added = home.length;
        rows = Arrays.copyOf(rows, rows.length + 1);
        rows[rows.length - 1] = row;
        basic = Arrays.copyOf(basic, rows.length);
        basic[rows.length - 1] = added;
        value = Arrays.copyOf(value, rows.length);
        value[rows.length - 1] = sum;
        home = Arrays.copyOf(home, added + 1);
        home[added] = rows.length - 1;
        lower = Arrays.copyOf(lower, added + 1);
        lower[added] = least;
        upper = Arrays.copyOf(upper, added + 1);
        upper[added] = Double.POSITIVE_INFINITY;
        return added;
    }

    /** Pivots until every variable is within its bounds, or cannot be. */
    Outcome solve() {
        var most = MIN_PIVOTS + PIVOTS_PER_ROW * rows.length;
        for (var pivots = 0; pivots < most; pivots++) {
            // after many pivots, the smallest variable: the other order could go round in a circle
            var row = pivots < most / 2 ? worstRow() : firstBadRow();
            if (row < 0) {
                return Outcome.SOLVED;
            }
            var isBelow = value[row] < lower[basic[row]];
            var column = entering(row, isBelow);
            if (column.isEmpty()) {
                stuckRow = row;
                return Outcome.INFEASIBLE;
            }
            pivot(row, column.getAsInt(), isBelow);
        }
        return Outcome.FAILED;
    }

    private double excess(int row) {
        return Math.max(lower[basic[row]] - value[row], value[row] - upper[basic[row]]);
    }

    private int worstRow() {
        var worst = -1;
        var most = FEASIBLE;
        for (var row = 0; row < rows.length; row++) {
            var excess = excess(row);
            if (excess > most) {
                most = excess;
                worst = row;
            }
        }
        return worst;
    }

    private int firstBadRow() {
        var first = -1;
        for (var row = 0; row < rows.length; row++) {
            if (excess(row) > FEASIBLE && (first < 0 || basic[row] < basic[first])) {
                first = row;
            }
        }
        return first;
    }

    /** The column that moves the row towards its bound and keeps the costs valid. */
    private OptionalInt entering(int row, boolean mustGrow) {
        var best = -1;
        var least = Double.POSITIVE_INFINITY;
        var coefficients = rows[row];
        for (var column = 0; column < free.length; column++) {
            var coefficient = coefficients[column];
            if (Math.abs(coefficient) < PIVOT || lower[free[column]] == upper[free[column]]) {
                continue;
            }
            var grows = coefficient > 0 != isAtUpper[column];
            if (grows != mustGrow) {
                continue;
            }
            var ratio = Math.abs(cost[column] / coefficient);
            if (ratio < least - ZERO
                    || ratio < least + ZERO && Math.abs(coefficient) > Math.abs(coefficients[best]) + PIVOT) {
                least = Math.min(least, ratio);
                best = column;
            }
        }
        work += free.length;
        return best < 0 ? OptionalInt.empty() : OptionalInt.of(best);
    }

    private void pivot(int row, int column, boolean isBelow) {
        var leaving = basic[row];
        var entering = free[column];
        var pivotRow = rows[row];
        var pivot = pivotRow[column];
        var move = ((isBelow ? lower[leaving] : upper[leaving]) - value[row]) / pivot;
        var newValue = standing(column) + move;
        var count = 0;
        for (var i = 0; i < pivotRow.length; i++) {
            if (Math.abs(pivotRow[i]) < ZERO) {
                pivotRow[i] = 0;
            } else if (i != column) {
                pivotRow[i] /= -pivot;
                touched[count++] = i;
            }
        }
        pivotRow[column] = 1 / pivot;
        for (var other = 0; other < rows.length; other++) {
            var factor = rows[other][column];
            if (other != row && factor != 0) {
                value[other] += factor * move;
                eliminate(rows[other], factor, pivotRow, column, count);
                work += count;
            }
        }
        eliminate(cost, cost[column], pivotRow, column, count);
        work += rows.length + pivotRow.length;
        value[row] = newValue;
        basic[row] = entering;
        home[entering] = row;
        free[column] = leaving;
        isAtUpper[column] = !isBelow;
        home[leaving] = -1 - column;
    }

    private void eliminate(double[] target, double factor, double[] pivotRow, int column, int count) {
        for (var k = 0; k < count; k++) {
            var i = touched[k];
            var sum = target[i] + factor * pivotRow[i];
            target[i] = Math.abs(sum) < ZERO ? 0 : sum;
        }
        target[column] = factor * pivotRow[column];
    }

    /**
     * After {@link Outcome#INFEASIBLE}: by variable, coefficients whose sum of products is the same in all solutions of
     * the rows, and less than that for all values within the bounds.
     */
    double[] multipliers() {
        var result = new double[home.length];
        var row = rows[stuckRow];
        var sign = value[stuckRow] < lower[basic[stuckRow]] ? 1 : -1;
        result[basic[stuckRow]] = -sign;
        for (var column = 0; column < free.length; column++) {
            result[free[column]] = sign * row[column];
        }
        return result;
    }
}
