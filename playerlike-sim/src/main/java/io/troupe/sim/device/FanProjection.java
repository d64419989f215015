package io.troupe.sim.device;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/**
 * Casts all rays of a fan by looking, for each thing near the robot, which of the rays may meet it.
 *
 * <p><b>Role.</b> For ranges, where only the least distance of a ray counts. The distance of a ray to an edge is
 * computed by {@link RayCaster#distanceM}, so the ranges are bit for bit those of rays that walk through the grid: the
 * least of the same numbers, in another order. What was hit is not recorded.
 *
 * <p><b>Structure.</b> Small outlines are circles, sorted by cells; the edges of large ones are in cells themselves.
 *
 * <p><b>Cost.</b> It grows with the number of things in range, also of those that others hide. So it suits fans of few
 * rays, and loses with many rays among many things.
 */
final class FanProjection {
    /** Outlines with a larger radius count as large. */
    private static final double LARGE_M = 1;

    private static final double CELL_M = 2;
    private static final int MOST_CELLS = 1 << 16;
    /** Larger than rounding errors. */
    private static final double MARGIN_M = 1e-6;

    private final Segments segments;
    private final double minX;
    private final double minY;
    private final double cellsPerM;
    private final int columns;
    private final int rows;

    // the small outlines, in order of creation
    private final int count;
    private final int[] small; // their numbers among all outlines
    private final int[] firstSegments;
    private final int[] endSegments;
    private final int[] carriers;
    private final int[] kinds;
    private final double[] radiiM;
    private final double greatestRadiusM;

    // the same, sorted by cell
    private final int[] starts;
    private final int[] cellOf;
    private final double[] x;
    private final double[] y;
    private final double[] radiusM;
    private final int[] outline;
    private final byte[] sizes; // of FanTable
    private final int sizesPresent;

    // the edges of the large outlines, by cell
    private final int[] edgeStarts;
    private final int[] edges;

    /** The outlines of a scene, each with its edges. */
    static final class Outlines {
        private final List<int[]> all = new ArrayList<>();
        private final List<Double> radiiM = new ArrayList<>();

        /** Adds an outline: the edges from one to before another one. */
        void add(int carrier, int rayKinds, int firstSegment, int endSegment, double radiusM) {
            all.add(new int[] {carrier, rayKinds, firstSegment, endSegment});
            radiiM.add(radiusM);
        }
    }

    /** @param moving the outlines move; then all of them count as small */
    FanProjection(Grid grid, Segments segments, Outlines outlines, boolean moving) {
        this.segments = segments;
        minX = grid.minX;
        minY = grid.minY;
        double width = grid.columns * grid.cellM;
        double height = grid.rows * grid.cellM;
        double cellM = Math.max(CELL_M, Math.sqrt(width * height / MOST_CELLS));
        cellsPerM = 1 / cellM;
        columns = (int) Math.ceil(width / cellM);
        rows = (int) Math.ceil(height / cellM);
        int[] found = new int[outlines.all.size()];
        int smallCount = 0;
        List<Integer> largeEdges = new ArrayList<>();
        for (int i = 0; i < found.length; i++) {
            if (moving || outlines.radiiM.get(i) <= LARGE_M) {
                found[smallCount++] = i;
            } else {
                int[] large = outlines.all.get(i);
                for (int s = large[2]; s < large[3]; s++) {
                    largeEdges.add(s);
                }
            }
        }
        count = smallCount;
        small = Arrays.copyOf(found, count);
        carriers = field(outlines, 0);
        kinds = field(outlines, 1);
        firstSegments = field(outlines, 2);
        endSegments = field(outlines, 3);
        radiiM = Arrays.stream(small).mapToDouble(outlines.radiiM::get).toArray();
        greatestRadiusM = Arrays.stream(radiiM).max().orElse(0) + MARGIN_M;
        starts = new int[columns * rows + 1];
        cellOf = new int[count];
        x = new double[count];
        y = new double[count];
        radiusM = new double[count];
        outline = new int[count];
        sizes = new byte[count];
        int present = 0;
        for (double radius : radiiM) {
            present |= FanTable.bit(FanTable.size(radius + MARGIN_M));
        }
        sizesPresent = present;
        edgeStarts = new int[columns * rows + 1];
        edges = sortEdges(largeEdges);
    }

    private int[] field(Outlines outlines, int index) {
        return Arrays.stream(small).map(i -> outlines.all.get(i)[index]).toArray();
    }

    private int[] sortEdges(List<Integer> largeEdges) {
        if (largeEdges.isEmpty()) {
            return new int[0];
        }
        var index = new int[1][];
        for (int pass = 0; pass < 2; pass++) {
            for (int i = largeEdges.size() - 1; i >= 0; i--) {
                int s = largeEdges.get(i);
                double toX = segments.x(s) + segments.dx(s);
                double toY = segments.y(s) + segments.dy(s);
                int lastColumn = column(Math.max(segments.x(s), toX) + MARGIN_M);
                int lastRow = row(Math.max(segments.y(s), toY) + MARGIN_M);
                for (int row = row(Math.min(segments.y(s), toY) - MARGIN_M); row <= lastRow; row++) {
                    for (int at = column(Math.min(segments.x(s), toX) - MARGIN_M); at <= lastColumn; at++) {
                        if (pass == 0) {
                            edgeStarts[row * columns + at]++;
                        } else {
                            index[0][--edgeStarts[row * columns + at]] = s;
                        }
                    }
                }
            }
            if (pass == 0) {
                for (int cell = 1; cell < edgeStarts.length; cell++) {
                    edgeStarts[cell] += edgeStarts[cell - 1];
                }
                index[0] = new int[edgeStarts[edgeStarts.length - 1]];
            }
        }
        return index[0];
    }

    private int column(double at) {
        double column = (at - minX) * cellsPerM;
        return column < 0 ? 0 : column >= columns ? columns - 1 : (int) column;
    }

    private int row(double at) {
        double row = (at - minY) * cellsPerM;
        return row < 0 ? 0 : row >= rows ? rows - 1 : (int) row;
    }

    /** Sets the carrier of an outline, by its number in order of creation, if all outlines move. */
    void setCarrier(int outlineNumber, int carrier) {
        carriers[outlineNumber] = carrier;
    }

    /** Sets which rays see an outline, as {@link #setCarrier}. */
    void setKinds(int outlineNumber, int rayKinds) {
        kinds[outlineNumber] = rayKinds;
    }

    /** An upper bound for the number of outlines and edges within reach of a robot. */
    int countNear(double robotX, double robotY, double maxM) {
        double boxM = maxM + greatestRadiusM;
        int firstColumn = column(robotX - boxM);
        int afterLast = column(robotX + boxM) + 1;
        int lastRow = row(robotY + boxM);
        int near = 0;
        for (int row = row(robotY - boxM); row <= lastRow; row++) {
            int cells = row * columns;
            near += starts[cells + afterLast] - starts[cells + firstColumn];
            near += edgeStarts[cells + afterLast] - edgeStarts[cells + firstColumn];
        }
        return near;
    }

    /**
     * Sorts the small outlines into cells, after they have moved.
     *
     * @param centreX by outline, in order of creation
     */
    void sort(double[] centreX, double[] centreY) {
        Arrays.fill(starts, 0);
        for (int i = 0; i < count; i++) {
            int cell = row(centreY[i]) * columns + column(centreX[i]);
            cellOf[i] = cell;
            starts[cell]++;
        }
        for (int cell = 1; cell < starts.length; cell++) {
            starts[cell] += starts[cell - 1];
        }
        for (int i = count - 1; i >= 0; i--) {
            int at = --starts[cellOf[i]];
            x[at] = centreX[i];
            y[at] = centreY[i];
            radiusM[at] = radiiM[i] + MARGIN_M;
            sizes[at] = FanTable.size(radiusM[at]);
            outline[at] = i;
        }
    }

    /** As {@link #sort(double[], double[])}, once, for outlines of which the large ones are left out. */
    void sort(List<Double> centreX, List<Double> centreY) {
        sort(
                Arrays.stream(small).mapToDouble(centreX::get).toArray(),
                Arrays.stream(small).mapToDouble(centreY::get).toArray());
    }

    /**
     * Shortens the distances of a robot's rays to the nearest edges.
     *
     * @param fan all parts of a fan
     * @param skip the carrier whose own edges stop no ray
     * @param rays the fan placed in the world, its distances infinite or those of other edges
     */
    void cast(
            double robotX,
            double robotY,
            double cos,
            double sin,
            List<FanTable> fan,
            int skip,
            int kind,
            double maxM,
            Rays rays) {
        castAtEdges(robotX, robotY, cos, sin, fan.getFirst(), skip, kind, maxM, rays);
        if (count > 0) {
            for (int i = 0; i < fan.size(); i++) {
                FanTable part = fan.get(i);
                find(robotX, robotY, cos, sin, part, maxM, rays.candidates);
                castAt(rays.candidates, part, skip, kind, maxM, rays);
            }
        }
    }

    /** Finds the small outlines that some rays may meet. */
    private void find(
            double robotX, double robotY, double cos, double sin, FanTable part, double maxM, Candidates candidates) {
        double reachCells = (maxM + part.offsetM + greatestRadiusM) * cellsPerM + MARGIN_M;
        char[][] masks = part.masks(sizesPresent);
        double entriesPerM = part.cellsPerM();
        int middleColumn = column(robotX);
        int middleRow = row(robotY);
        int rowsAside = (int) reachCells + 1;
        int found = 0;
        int lastRow = Math.min(rows - 1, middleRow + rowsAside);
        for (int row = Math.max(0, middleRow - rowsAside); row <= lastRow; row++) {
            if (starts[row * columns] == starts[(row + 1) * columns]) {
                continue; // nothing is in the row
            }
            int off = Math.max(0, Math.abs(row - middleRow) - 1); // in cells, at least
            int columnsAside = (int) Math.sqrt(reachCells * reachCells - off * off) + 1;
            int first = starts[row * columns + Math.max(0, middleColumn - columnsAside)];
            int end = starts[row * columns + Math.min(columns - 1, middleColumn + columnsAside) + 1];
            candidates.fit(found + end - first);
            int[] at = candidates.at;
            char[] rays = candidates.rays;
            double[] ahead = candidates.ahead;
            double[] left = candidates.left;
            for (int k = first; k < end; k++) {
                double dx = x[k] - robotX;
                double dy = y[k] - robotY;
                double forward = cos * dx + sin * dy;
                double aside = cos * dy - sin * dx;
                int mask = masks[sizes[k]][FanTable.index(forward, aside, entriesPerM)];
                at[found] = k;
                rays[found] = (char) mask;
                ahead[found] = forward;
                left[found] = aside;
                found += -mask >>> 31; // stays there for the next one if no ray may meet this one; without a branch
            }
        }
        candidates.count = found;
    }

    private void castAt(Candidates candidates, FanTable part, int skip, int kind, double maxM, Rays rays) {
        double[] dirX = part.fan.dirX;
        double[] dirY = part.fan.dirY;
        double[] distancesM = rays.distanceM;
        for (int c = 0; c < candidates.count; c++) {
            int k = candidates.at[c];
            int i = outline[k];
            if ((kinds[i] & kind) == 0 || carriers[i] == skip) {
                continue;
            }
            double radius = radiusM[k];
            double ahead = candidates.ahead[c];
            double left = candidates.left[c];
            for (int mask = candidates.rays[c]; mask != 0; mask &= mask - 1) {
                int ray = part.firstRay + Integer.numberOfTrailingZeros(mask);
                double side = dirX[ray] * left - dirY[ray] * ahead - part.aside[ray];
                if (Math.abs(side) > radius) {
                    continue;
                }
                double along = dirX[ray] * ahead + dirY[ray] * left - part.before[ray];
                if (along >= -radius && along - radius <= distancesM[ray]) {
                    for (int s = firstSegments[i]; s < endSegments[i]; s++) {
                        meet(s, ray, maxM, rays);
                    }
                }
            }
        }
    }

    private void castAtEdges(
            double robotX,
            double robotY,
            double cos,
            double sin,
            FanTable part,
            int skip,
            int kind,
            double maxM,
            Rays rays) {
        if (edges.length == 0) {
            return;
        }
        RayFan fan = part.fan;
        double reachM = maxM + part.offsetM + MARGIN_M;
        int firstColumn = column(robotX - reachM);
        int lastColumn = column(robotX + reachM);
        int query = rays.nextQuery(segments.count);
        for (int row = row(robotY - reachM); row <= row(robotY + reachM); row++) {
            int end = edgeStarts[row * columns + lastColumn + 1];
            for (int k = edgeStarts[row * columns + firstColumn]; k < end; k++) {
                int s = edges[k];
                if (rays.seenIn[s] == query) {
                    continue;
                }
                rays.seenIn[s] = query;
                double ax = segments.x(s) - robotX;
                double ay = segments.y(s) - robotY;
                double edgeX = segments.dx(s);
                double edgeY = segments.dy(s);
                double bx = ax + edgeX;
                double by = ay + edgeY;
                // the distance of the robot from the line, times the edge's length; positive outside
                double outside = ay * edgeX - ax * edgeY;
                double lengthM = Math.abs(edgeX) + Math.abs(edgeY);
                if (outside < -(part.offsetM + MARGIN_M) * lengthM
                        || outside > reachM * lengthM
                        || Math.min(ax, bx) > reachM
                        || Math.max(ax, bx) < -reachM
                        || Math.min(ay, by) > reachM
                        || Math.max(ay, by) < -reachM
                        || !segments.stops(s, kind, skip)) {
                    continue;
                }
                double aheadA = cos * ax + sin * ay;
                double leftA = cos * ay - sin * ax;
                double aheadB = cos * bx + sin * by;
                double leftB = cos * by - sin * bx;
                for (int ray = 0; ray < fan.size(); ray++) {
                    double sideA = fan.dirX[ray] * leftA - fan.dirY[ray] * aheadA - part.aside[ray];
                    double sideB = fan.dirX[ray] * leftB - fan.dirY[ray] * aheadB - part.aside[ray];
                    // the body lies to the left of the edge: seen from outside, the edge runs from left to right
                    if (sideA >= -MARGIN_M && sideB <= MARGIN_M) {
                        meet(s, ray, maxM, rays);
                    }
                }
            }
        }
    }

    private void meet(int s, int ray, double maxM, Rays rays) {
        double distanceM =
                RayCaster.distanceM(segments, s, rays.x[ray], rays.y[ray], rays.dirX[ray], rays.dirY[ray], maxM);
        if (distanceM < rays.distanceM[ray]) {
            rays.distanceM[ray] = distanceM;
        }
    }

    /** Outlines that some rays may meet; working memory of one thread. */
    private static final class Candidates {
        private int count;
        private int[] at = new int[0]; // place in the order by cells
        private char[] rays = new char[0];
        private double[] ahead = new double[0]; // of the centre, in the robot's frame
        private double[] left = new double[0];

        /** Makes room, and for one more, which may be written without being counted. */
        void fit(int wanted) {
            if (at.length <= wanted) {
                int length = Math.max(64, 2 * wanted);
                at = Arrays.copyOf(at, length);
                rays = Arrays.copyOf(rays, length);
                ahead = Arrays.copyOf(ahead, length);
                left = Arrays.copyOf(left, length);
            }
        }
    }

    /** The rays of a fan in the world, and how far each of them goes; working memory of one thread. */
    static final class Rays {
        double[] x = new double[0];
        double[] y = new double[0];
        double[] dirX = new double[0];
        double[] dirY = new double[0];
        double[] distanceM = new double[0];
        private final Candidates candidates = new Candidates();
        private int[] seenIn = new int[0]; // by edge, the last query that saw it
        private int query;

        void fit(int rays) {
            if (x.length < rays) {
                x = new double[rays];
                y = new double[rays];
                dirX = new double[rays];
                dirY = new double[rays];
                distanceM = new double[rays];
            }
        }

        private int nextQuery(int segmentCount) {
            if (seenIn.length < segmentCount) {
                seenIn = new int[segmentCount];
            }
            query++;
            if (query == 0) { // after four thousand million queries
                Arrays.fill(seenIn, 0);
                query = 1;
            }
            return query;
        }
    }
}
