package io.troupe.sim.device;

import java.util.Arrays;
import java.util.List;

/**
 * Finds the distance to the nearest of many walls, by searching the cells around a body from near to far.
 *
 * <p><b>Threads.</b> One thread at a time. <b>Cost.</b> Compares the walls in the cells (of two metres) under the body
 * and in the rings of cells around it, until the next ring is farther away than the nearest wall found. Allocates
 * nothing.
 */
final class NearestWalls {
    private static final double CELL_M = 2;
    /** Limits the size of the table for a world that is kilometres long and has few walls. */
    private static final int MOST_CELLS_ALONG = 512;
    /** Far larger than rounding errors. */
    private static final double ROUNDING_M = 1e-6;

    private final ConvexPolygon[] pieces;
    private final int[] comparedIn; // for each piece, the last query that compared it
    private final int[][] cells;
    private final double minX;
    private final double minY;
    private final double cellM;
    private final int columns;
    private final int rows;
    private int query;

    NearestWalls(List<Outline> walls) {
        pieces = walls.stream().flatMap(wall -> wall.polygons().stream()).toArray(ConvexPolygon[]::new);
        comparedIn = new int[pieces.length];
        double leastX = Double.POSITIVE_INFINITY;
        double leastY = Double.POSITIVE_INFINITY;
        double mostX = Double.NEGATIVE_INFINITY;
        double mostY = Double.NEGATIVE_INFINITY;
        for (ConvexPolygon piece : pieces) {
            leastX = Math.min(leastX, piece.minX);
            leastY = Math.min(leastY, piece.minY);
            mostX = Math.max(mostX, piece.maxX);
            mostY = Math.max(mostY, piece.maxY);
        }
        minX = leastX;
        minY = leastY;
        double longest = pieces.length == 0 ? 0 : Math.max(mostX - leastX, mostY - leastY);
        cellM = Math.max(CELL_M, longest / MOST_CELLS_ALONG);
        columns = pieces.length == 0 ? 0 : (int) ((mostX - leastX) / cellM) + 1;
        rows = pieces.length == 0 ? 0 : (int) ((mostY - leastY) / cellM) + 1;
        cells = new int[columns * rows][];
        Arrays.fill(cells, new int[0]);
        for (int i = 0; i < pieces.length; i++) {
            for (int row = row(pieces[i].minY); row <= row(pieces[i].maxY); row++) {
                for (int column = column(pieces[i].minX); column <= column(pieces[i].maxX); column++) {
                    int cell = row * columns + column;
                    cells[cell] = Arrays.copyOf(cells[cell], cells[cell].length + 1);
                    cells[cell][cells[cell].length - 1] = i;
                }
            }
        }
    }

    private int column(double x) {
        return Math.clamp((long) Math.floor((x - minX) / cellM), 0, columns - 1);
    }

    private int row(double y) {
        return Math.clamp((long) Math.floor((y - minY) / cellM), 0, rows - 1);
    }

    /** Distance from edge to edge; 0 if they touch or overlap, infinite if there are no walls. */
    double gapM(Outline body) {
        if (pieces.length == 0) {
            return Double.POSITIVE_INFINITY;
        }
        double gap = Double.POSITIVE_INFINITY;
        List<ConvexPolygon> mine = body.polygons();
        for (int i = 0; i < mine.size(); i++) {
            gap = Math.min(gap, gapM(mine.get(i), gap));
        }
        return gap;
    }

    private double gapM(ConvexPolygon mine, double limitM) {
        query++;
        double gap = limitM;
        int left = column(mine.minX);
        int right = column(mine.maxX);
        int bottom = row(mine.minY);
        int top = row(mine.maxY);
        int rings = Math.max(Math.max(left, columns - 1 - right), Math.max(bottom, rows - 1 - top));
        // A wall that is in ring n and in no nearer ring is at least n - 1 cells away. A body outside all cells
        // counts as in the nearest cell, which gives a lower bound of the distance.
        for (int ring = 0; ring <= rings && (ring - 1) * cellM - ROUNDING_M < gap; ring++) {
            for (int row = Math.max(0, bottom - ring); row <= Math.min(rows - 1, top + ring); row++) {
                boolean whole = row == bottom - ring || row == top + ring;
                int step = whole || ring == 0 ? 1 : right - left + 2 * ring;
                for (int column = left - ring; column <= right + ring; column += step) {
                    if (column >= 0 && column < columns) {
                        gap = nearest(mine, cells[row * columns + column], gap);
                    }
                }
            }
        }
        return gap;
    }

    private double nearest(ConvexPolygon mine, int[] cell, double limitM) {
        double gap = limitM;
        for (int index : cell) {
            if (comparedIn[index] != query) {
                comparedIn[index] = query;
                ConvexPolygon wall = pieces[index];
                if (mine.gapAtLeast(wall) < gap) {
                    gap = Math.min(gap, mine.gap(wall));
                }
            }
        }
        return gap;
    }
}
