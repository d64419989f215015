package io.troupe.sim.device;

import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.Shape;
import java.util.List;

/**
 * Finds what a ray hits first: the outlines of all things in a uniform grid of {@value #CELL_M} m cells.
 *
 * <p><b>Role.</b> Obstacles are put in once, robots again at every tick with {@link #placeRobots}.
 * <p><b>Threads.</b> One at a time. <b>Cost.</b> A cast visits the cells on its way and allocates nothing.
 * <p><b>Units and shapes.</b> Metres, exact segments; of two things at the same distance the one put in first counts.
 */
public final class RayGrid {
    /** Sonar rays end at the thing. */
    public static final int FOR_RANGERS = 1;
    /** The camera sees the thing. */
    public static final int FOR_CAMERAS = 2;
    /** Casts that no robot makes. */
    public static final int NOBODY = -1;

    private static final double CELL_M = 1;

    /** Something with an outline. */
    public record Thing(Shape shape, int colour, int flags) {}

    private final double left;
    private final double bottom;
    private final int columns;
    private final int rows;
    private final SegmentBins obstacles;
    private final SegmentBins robots;
    private final List<Thing> robotThings;
    private int hitColour;

    /**
     * A grid that covers all obstacles, and robots as long as they are among them; what is outside is kept in the cells at the edge.
     *
     * @param poses of the obstacles
     */
    public RayGrid(List<Thing> obstacles, List<Pose> poses, List<Thing> robots) {
        var extent = Extent.of(obstacles, poses);
        left = extent.left() - CELL_M;
        bottom = extent.bottom() - CELL_M;
        columns = (int) Math.ceil((extent.right() + CELL_M - left) / CELL_M);
        rows = (int) Math.ceil((extent.top() + CELL_M - bottom) / CELL_M);
        this.obstacles = new SegmentBins(columns * rows);
        this.robots = new SegmentBins(columns * rows);
        this.robotThings = List.copyOf(robots);
        for (int index = 0; index < obstacles.size(); index++) {
            add(this.obstacles, obstacles.get(index), poses.get(index), NOBODY);
        }
        this.obstacles.bin(this::cellsOf);
    }

    /** Puts the robots where they are now. */
    public void placeRobots(List<Pose> poses) {
        robots.clear();
        for (int index = 0; index < robotThings.size(); index++) {
            add(robots, robotThings.get(index), poses.get(index), index);
        }
        robots.bin(this::cellsOf);
    }

    private static void add(SegmentBins bins, Thing thing, Pose pose, int robot) {
        for (List<Point> polygon : thing.shape().polygons()) {
            Point from = pose.place(polygon.getLast());
            for (Point corner : polygon) {
                Point to = pose.place(corner);
                bins.add(from.x(), from.y(), to.x(), to.y(), robot, thing.flags(), thing.colour());
                from = to;
            }
        }
    }

    /**
     * Casts a ray.
     *
     * @param headingRad in the world's frame
     * @param maxM how far it reaches
     * @param skippedRobot the robot that casts it and does not see itself, or {@link #NOBODY}
     * @param flag what it looks for: {@link #FOR_RANGERS} or {@link #FOR_CAMERAS}
     * @return the distance of the first hit, or {@code maxM} if there is none; then {@link #hit} is false
     */
    public double cast(double x, double y, double headingRad, double maxM, int skippedRobot, int flag) {
        double dx = StrictMath.cos(headingRad);
        double dy = StrictMath.sin(headingRad);
        int column = column(x);
        int row = row(y);
        int stepX = dx > 0 ? 1 : -1;
        int stepY = dy > 0 ? 1 : -1;
        double perCellX = dx == 0 ? Double.POSITIVE_INFINITY : CELL_M / Math.abs(dx);
        double perCellY = dy == 0 ? Double.POSITIVE_INFINITY : CELL_M / Math.abs(dy);
        double nextX = distanceToBorder(x - left, column, dx);
        double nextY = distanceToBorder(y - bottom, row, dy);
        double best = maxM;
        hitColour = -1;
        while (true) {
            int cell = row * columns + column;
            best = nearest(obstacles, cell, x, y, dx, dy, best, NOBODY - 1, flag);
            best = nearest(robots, cell, x, y, dx, dy, best, skippedRobot, flag);
            if (nextX < nextY) {
                if (nextX >= best) {
                    return best;
                }
                column += stepX;
                nextX += perCellX;
            } else {
                if (nextY >= best) {
                    return best;
                }
                row += stepY;
                nextY += perCellY;
            }
            if (column < 0 || column >= columns || row < 0 || row >= rows) {
                return best;
            }
        }
    }

    /** Whether the last cast hit something. */
    public boolean hit() {
        return hitColour >= 0;
    }

    /** The colour of what the last cast hit. */
    public int hitColour() {
        return hitColour;
    }

    private double nearest(
            SegmentBins bins,
            int cell,
            double x,
            double y,
            double dx,
            double dy,
            double best,
            int skippedRobot,
            int flag) {
        for (int at = bins.first(cell); at < bins.first(cell + 1); at++) {
            int segment = bins.entry(at);
            if (bins.robot(segment) != skippedRobot && (bins.flags(segment) & flag) != 0) {
                double distance = bins.distance(segment, x, y, dx, dy);
                if (distance < best) {
                    best = distance;
                    hitColour = bins.colour(segment);
                }
            }
        }
        return best;
    }

    /** Along a ray with direction component d, from offset o in a cell to the cell's border. */
    private static double distanceToBorder(double offset, int cell, double d) {
        if (d == 0) {
            return Double.POSITIVE_INFINITY;
        }
        double border = d > 0 ? (cell + 1) * CELL_M : cell * CELL_M;
        return Math.max(0, (border - offset) / d);
    }

    private int column(double x) {
        return Math.clamp((long) Math.floor((x - left) / CELL_M), 0, columns - 1);
    }

    private int row(double y) {
        return Math.clamp((long) Math.floor((y - bottom) / CELL_M), 0, rows - 1);
    }

    private void cellsOf(double x1, double y1, double x2, double y2, SegmentBins.Cells cells) {
        int firstRow = row(Math.min(y1, y2));
        int lastRow = row(Math.max(y1, y2));
        int firstColumn = column(Math.min(x1, x2));
        int lastColumn = column(Math.max(x1, x2));
        for (int row = firstRow; row <= lastRow; row++) {
            for (int column = firstColumn; column <= lastColumn; column++) {
                cells.visit(row * columns + column);
            }
        }
    }

    /** The rectangle around things. */
    private record Extent(double left, double bottom, double right, double top) {
        static Extent of(List<Thing> things, List<Pose> poses) {
            double[] edges = {0, 0, 0, 0};
            for (int index = 0; index < things.size(); index++) {
                for (var polygon : things.get(index).shape().polygons()) {
                    for (var corner : polygon) {
                        Point point = poses.get(index).place(corner);
                        edges[0] = Math.min(edges[0], point.x());
                        edges[1] = Math.min(edges[1], point.y());
                        edges[2] = Math.max(edges[2], point.x());
                        edges[3] = Math.max(edges[3], point.y());
                    }
                }
            }
            return new Extent(edges[0], edges[1], edges[2], edges[3]);
        }
    }
}
