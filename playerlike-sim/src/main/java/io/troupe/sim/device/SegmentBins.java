package io.troupe.sim.device;

import java.util.Arrays;

/** Line segments, and for each cell of a grid the numbers of those that may cross it; plain arrays, for speed. */
final class SegmentBins {
    /** Is told the cells of a segment. */
    interface Cells {
        void visit(int cell);
    }

    /** Finds the cells of a segment. */
    interface Covering {
        void cellsOf(double x1, double y1, double x2, double y2, Cells cells);
    }

    private static final int COORDINATES = 4;

    private final int[] firsts;
    private int[] entries = new int[64];
    private double[] ends = new double[64];
    private int[] robots = new int[16];
    private int[] flags = new int[16];
    private int[] colours = new int[16];
    private int size;

    SegmentBins(int cells) {
        firsts = new int[cells + 1];
    }

    void clear() {
        size = 0;
    }

    void add(double x1, double y1, double x2, double y2, int robot, int flag, int colour) {
        if (size == robots.length) {
            ends = Arrays.copyOf(ends, 2 * ends.length);
            robots = Arrays.copyOf(robots, 2 * size);
            flags = Arrays.copyOf(flags, 2 * size);
            colours = Arrays.copyOf(colours, 2 * size);
        }
        int at = COORDINATES * size;
        ends[at] = x1;
        ends[at + 1] = y1;
        ends[at + 2] = x2;
        ends[at + 3] = y2;
        robots[size] = robot;
        flags[size] = flag;
        colours[size] = colour;
        size++;
    }

    /** Sorts the segments into cells by counting; within a cell they keep the order in which they were added. */
    void bin(Covering covering) {
        Arrays.fill(firsts, 0);
        visitAll(covering, (segment, cell) -> firsts[cell + 1]++);
        for (int cell = 1; cell < firsts.length; cell++) {
            firsts[cell] += firsts[cell - 1];
        }
        if (entries.length < firsts[firsts.length - 1]) {
            entries = new int[2 * firsts[firsts.length - 1]];
        }
        visitAll(covering, (segment, cell) -> entries[firsts[cell]++] = segment);
        System.arraycopy(firsts, 0, firsts, 1, firsts.length - 1); // each has moved to where the next begins
        firsts[0] = 0;
    }

    private interface SegmentInCell {
        void visit(int segment, int cell);
    }

    private void visitAll(Covering covering, SegmentInCell visitor) {
        for (int segment = 0; segment < size; segment++) {
            int number = segment;
            int at = COORDINATES * segment;
            covering.cellsOf(ends[at], ends[at + 1], ends[at + 2], ends[at + 3], cell -> visitor.visit(number, cell));
        }
    }

    /** Where the entries of a cell begin; those of the next cell begin where they end. */
    int first(int cell) {
        return firsts[cell];
    }

    int entry(int at) {
        return entries[at];
    }

    int robot(int segment) {
        return robots[segment];
    }

    int flags(int segment) {
        return flags[segment];
    }

    int colour(int segment) {
        return colours[segment];
    }

    /** How far along the ray the segment is; infinity if the ray misses it. */
    double distance(int segment, double x, double y, double dx, double dy) {
        int at = COORDINATES * segment;
        double fromX = ends[at] - x;
        double fromY = ends[at + 1] - y;
        double alongX = ends[at + 2] - ends[at];
        double alongY = ends[at + 3] - ends[at + 1];
        double cross = dx * alongY - dy * alongX;
        if (cross == 0) {
            return Double.POSITIVE_INFINITY; // parallel: its neighbours in the outline are hit instead
        }
        double distance = (fromX * alongY - fromY * alongX) / cross;
        double part = (fromX * dy - fromY * dx) / cross;
        return distance >= 0 && part >= 0 && part <= 1 ? distance : Double.POSITIVE_INFINITY;
    }
}
