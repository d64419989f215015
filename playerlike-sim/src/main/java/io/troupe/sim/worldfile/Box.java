package io.troupe.sim.worldfile;

import io.troupe.sim.model.Point;
import java.util.List;
import java.util.Locale;

/** An axis-aligned rectangle, in metres. */
record Box(double minX, double minY, double maxX, double maxY) {
    /** The empty box; the start for {@link #union}. */
    static final Box NOTHING = new Box(
            Double.POSITIVE_INFINITY, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY, Double.NEGATIVE_INFINITY);

    static Box around(List<List<Point>> polygons) {
        Box box = NOTHING;
        for (List<Point> polygon : polygons) {
            for (Point p : polygon) {
                box = box.union(new Box(p.x(), p.y(), p.x(), p.y()));
            }
        }
        return box;
    }

    Box union(Box other) {
        return new Box(
                Math.min(minX, other.minX),
                Math.min(minY, other.minY),
                Math.max(maxX, other.maxX),
                Math.max(maxY, other.maxY));
    }

    boolean meets(Box other) {
        return minX <= other.maxX && other.minX <= maxX && minY <= other.maxY && other.minY <= maxY;
    }

    boolean holds(double x, double y) {
        return minX <= x && x <= maxX && minY <= y && y <= maxY;
    }

    /** Largest distance of any of its points from zero along x or y. */
    double reach() {
        return Math.max(Math.max(Math.abs(minX), Math.abs(maxX)), Math.max(Math.abs(minY), Math.abs(maxY)));
    }

    double width() {
        return maxX - minX;
    }

    double height() {
        return maxY - minY;
    }

    @Override
    public String toString() {
        return String.format(Locale.ROOT, "x from %.3f to %.3f, y from %.3f to %.3f", minX, maxX, minY, maxY);
    }
}
