package io.troupe.sim.device;

/** A grid of square cells; cells at the rim extend to infinity, so that every point is in a cell. */
final class Grid {
    private static final double LEAST_CELL_M = 1;
    private static final int MOST_CELLS = 1 << 16;

    final double minX;
    final double minY;
    final double cellM;
    final int columns;
    final int rows;

    Grid(double minX, double minY, double maxX, double maxY) {
        double width = Math.max(maxX - minX, LEAST_CELL_M);
        double height = Math.max(maxY - minY, LEAST_CELL_M);
        this.minX = minX;
        this.minY = minY;
        cellM = Math.max(LEAST_CELL_M, Math.sqrt(width * height / MOST_CELLS));
        columns = (int) Math.ceil(width / cellM);
        rows = (int) Math.ceil(height / cellM);
    }

    int column(double x) {
        return Math.clamp((long) Math.floor((x - minX) / cellM), 0, columns - 1);
    }

    int row(double y) {
        return Math.clamp((long) Math.floor((y - minY) / cellM), 0, rows - 1);
    }

    int cellCount() {
        return columns * rows;
    }
}
