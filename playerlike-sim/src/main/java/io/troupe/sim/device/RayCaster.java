package io.troupe.sim.device;

/**
 * Finds the first segment on a ray by walking through the grid cells that the ray crosses.
 *
 * <p>Only a segment's outer side stops a ray: a ray that starts inside a body does not see that body. Of several things
 * at the same distance, that in the earlier cell of the ray is hit, in a cell a fixed thing before a moving one, and
 * then the one whose segment comes first. For ranges this does not matter, and {@link FanProjection} may find them
 * instead.
 */
final class RayCaster {
    /** Tolerance at segment ends, so that a ray through a corner cannot slip between two segments. */
    private static final double CORNER = 1e-12;
    /** Tolerance of the test without division: larger than CORNER and than rounding errors. */
    private static final double FAR = 1e-6;

    private final Grid grid;
    private final CellIndex fixed;
    private final CellIndex moving;

    RayCaster(Grid grid, CellIndex fixed, CellIndex moving) {
        this.grid = grid;
        this.fixed = fixed;
        this.moving = moving;
    }

    void cast(Ray ray) {
        ray.hitThing = Ray.NOTHING;
        ray.hitM = Double.POSITIVE_INFINITY;
        int column = grid.column(ray.x);
        int row = grid.row(ray.y);
        int columnStep = ray.dirX > 0 ? 1 : -1;
        int rowStep = ray.dirY > 0 ? 1 : -1;
        int lastColumn = ray.dirX > 0 ? grid.columns - 1 : 0;
        int lastRow = ray.dirY > 0 ? grid.rows - 1 : 0;
        // distances along the ray to the next column and row of cells, and from one to the next after that
        double toColumn = crossingM(grid.minX, ray.dirX > 0 ? column + 1 : column, ray.x, ray.dirX);
        double toRow = crossingM(grid.minY, ray.dirY > 0 ? row + 1 : row, ray.y, ray.dirY);
        double acrossColumn = grid.cellM / Math.abs(ray.dirX);
        double acrossRow = grid.cellM / Math.abs(ray.dirY);
        while (true) {
            int cell = row * grid.columns + column;
            nearest(fixed, cell, ray);
            nearest(moving, cell, ray);
            double columnEnd = column == lastColumn ? Double.POSITIVE_INFINITY : toColumn;
            double rowEnd = row == lastRow ? Double.POSITIVE_INFINITY : toRow;
            if (Math.min(columnEnd, rowEnd) >= Math.min(ray.hitM, ray.maxM)) {
                return;
            }
            if (columnEnd <= rowEnd) {
                column += columnStep;
                toColumn += acrossColumn;
            } else {
                row += rowStep;
                toRow += acrossRow;
            }
        }
    }

    private double crossingM(double min, int line, double from, double dir) {
        return dir == 0 ? Double.POSITIVE_INFINITY : (min + line * grid.cellM - from) / dir;
    }

    private static void nearest(CellIndex index, int cell, Ray ray) {
        Segments segments = index.segments;
        int end = index.start[cell + 1];
        for (int i = index.start[cell]; i < end; i++) {
            int s = index.items[i];
            if (segments.stops(s, ray.kind, ray.skip)) {
                meet(segments, s, ray);
            }
        }
    }

    private static void meet(Segments segments, int s, Ray ray) {
        double distanceM = distanceM(segments, s, ray.x, ray.y, ray.dirX, ray.dirY, ray.maxM);
        if (distanceM < ray.hitM) {
            ray.hitM = distanceM;
            ray.hitThing = segments.thing(s);
        }
    }

    /** Distance from the start of a ray to the outer side of an edge; infinite if it does not meet it in range. */
    static double distanceM(Segments segments, int s, double x, double y, double dirX, double dirY, double maxM) {
        double dx = segments.dx(s);
        double dy = segments.dy(s);
        double facing = dx * dirY - dy * dirX; // positive: the ray comes from the right, which is outside
        if (!(facing > 0)) {
            return Double.POSITIVE_INFINITY;
        }
        double offX = segments.x(s) - x;
        double offY = segments.y(s) - y;
        double distanceShare = offY * dx - offX * dy;
        double alongShare = offY * dirX - offX * dirY;
        // rejects most segments, which are far off, without a division
        if (distanceShare < 0 || alongShare < -FAR * facing || alongShare > (1 + FAR) * facing) {
            return Double.POSITIVE_INFINITY;
        }
        double distanceM = distanceShare / facing;
        double along = alongShare / facing;
        boolean onSegment = along >= -CORNER && along <= 1 + CORNER;
        return onSegment && distanceM <= maxM ? distanceM : Double.POSITIVE_INFINITY;
    }
}
