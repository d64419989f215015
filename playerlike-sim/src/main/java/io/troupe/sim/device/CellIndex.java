package io.troupe.sim.device;

import java.util.Arrays;

/**
 * Index of the segments that pass through each cell of a grid: those of cell {@code c} are {@code items[start[c]] ..
 * items[start[c + 1]]}.
 */
final class CellIndex {
    /** Margin of a cell: a segment on the line between two cells belongs to both. */
    private static final double MARGIN_M = 1e-9;

    private final Grid grid;
    final Segments segments;
    final int[] start;
    int[] items = new int[64];

    CellIndex(Grid grid, Segments segments) {
        this.grid = grid;
        this.segments = segments;
        start = new int[grid.cellCount() + 1];
    }

    /** Sorts the segments into cells by counting; in each cell they stay in order. */
    void rebuild() {
        Arrays.fill(start, 0);
        visit(true);
        for (int cell = 1; cell < start.length; cell++) {
            start[cell] += start[cell - 1];
        }
        int total = start[start.length - 1];
        if (items.length < total) {
            items = new int[Math.max(total, 2 * items.length)];
        }
        visit(false);
    }

    /**
     * Visits the cells of all segments. Counting leaves the end of cell {@code c} in {@code start[c]}; filling runs
     * from the last segment back and leaves its start there.
     */
    private void visit(boolean counting) {
        for (int s = segments.count - 1; s >= 0; s--) {
            double toX = segments.x(s) + segments.dx(s);
            double toY = segments.y(s) + segments.dy(s);
            int firstColumn = grid.column(Math.min(segments.x(s), toX) - MARGIN_M);
            int lastColumn = grid.column(Math.max(segments.x(s), toX) + MARGIN_M);
            int firstRow = grid.row(Math.min(segments.y(s), toY) - MARGIN_M);
            int lastRow = grid.row(Math.max(segments.y(s), toY) + MARGIN_M);
            boolean slanted = firstColumn != lastColumn && firstRow != lastRow;
            for (int row = firstRow; row <= lastRow; row++) {
                for (int column = firstColumn; column <= lastColumn; column++) {
                    if (slanted && misses(s, column, row)) {
                        continue;
                    }
                    int cell = row * grid.columns + column;
                    if (counting) {
                        start[cell]++;
                    } else {
                        items[--start[cell]] = s;
                    }
                }
            }
        }
    }

    /** True if all corners of an inner cell lie on one side of the segment's line. */
    private boolean misses(int s, int column, int row) {
        if (column == 0 || row == 0 || column == grid.columns - 1 || row == grid.rows - 1) {
            return false;
        }
        double half = grid.cellM / 2;
        double offX = grid.minX + column * grid.cellM + half - segments.x(s);
        double offY = grid.minY + row * grid.cellM + half - segments.y(s);
        double dx = segments.dx(s);
        double dy = segments.dy(s);
        double reach = (half + MARGIN_M) * (Math.abs(dx) + Math.abs(dy));
        return Math.abs(dx * offY - dy * offX) > reach;
    }
}
