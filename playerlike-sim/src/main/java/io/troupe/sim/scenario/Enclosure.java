package io.troupe.sim.scenario;

import java.util.ArrayDeque;
import java.util.List;

/**
 * Distinguishes walls around a space from separate obstacles in the open, by a flood fill from outside over a grid of
 * cells.
 *
 * <p>A gap narrower than a cell, a hundredth of the extent, counts as closed.
 */
final class Enclosure {
    private static final int CELLS = 100;

    private final Box extent;
    /** With one more row of cells on each side, from which the flood fill starts. */
    private final boolean[][] taken = new boolean[CELLS + 2][CELLS + 2];

    private Enclosure(Box extent) {
        this.extent = extent;
    }

    /** True if the extent contains free space that cannot be reached from outside. */
    static boolean isClosed(Box extent, List<List<Point>> convexPieces) {
        if (convexPieces.isEmpty()) {
            return false;
        }
        var enclosure = new Enclosure(extent);
        convexPieces.forEach(enclosure::markTaken);
        enclosure.flood();
        for (boolean[] column : enclosure.taken) {
            for (boolean cell : column) {
                if (!cell) {
                    return true;
                }
            }
        }
        return false;
    }

    private void markTaken(List<Point> piece) {
        double width = extent.width() / CELLS;
        double height = extent.height() / CELLS;
        Box box = Box.around(List.of(piece));
        int lastX = cell(box.maxX() - extent.minX(), width);
        int lastY = cell(box.maxY() - extent.minY(), height);
        for (int x = cell(box.minX() - extent.minX(), width); x <= lastX; x++) {
            for (int y = cell(box.minY() - extent.minY(), height); y <= lastY; y++) {
                double left = extent.minX() + x * width;
                double below = extent.minY() + y * height;
                List<Point> cell = Polygons.rectangle(left, below, left + width, below + height);
                if (!taken[x + 1][y + 1] && Polygons.overlap(piece, cell)) {
                    taken[x + 1][y + 1] = true;
                }
            }
        }
    }

    private static int cell(double distance, double cellSize) {
        return Math.clamp((long) (distance / cellSize), 0, CELLS - 1);
    }

    private void flood() {
        var front = new ArrayDeque<int[]>();
        fill(front, 0, 0);
        while (!front.isEmpty()) {
            int[] cell = front.remove();
            fill(front, cell[0] - 1, cell[1]);
            fill(front, cell[0] + 1, cell[1]);
            fill(front, cell[0], cell[1] - 1);
            fill(front, cell[0], cell[1] + 1);
        }
    }

    private void fill(ArrayDeque<int[]> front, int x, int y) {
        boolean inside = x >= 0 && y >= 0 && x < CELLS + 2 && y < CELLS + 2;
        if (inside && !taken[x][y]) {
            taken[x][y] = true;
            front.add(new int[] {x, y});
        }
    }
}
