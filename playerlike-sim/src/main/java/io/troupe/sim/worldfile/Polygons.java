package io.troupe.sim.worldfile;

import io.troupe.sim.model.Point;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** Plane geometry of polygons in metres. */
final class Polygons {
    /** Points nearer than this, a micrometre, count as the same. */
    static final double SAME_PLACE_M = 1e-6;

    private static final double TOUCHING_M = 1e-9;

    private Polygons() {}

    static List<Point> rectangle(double minX, double minY, double maxX, double maxY) {
        return List.of(new Point(minX, minY), new Point(maxX, minY), new Point(maxX, maxY), new Point(minX, maxY));
    }

    /** Positive if the vertices run counter-clockwise. */
    static double signedArea(List<Point> polygon) {
        double twice = 0;
        Point b = polygon.getLast();
        for (Point a : polygon) {
            twice += b.x() * a.y() - a.x() * b.y();
            b = a;
        }
        return twice / 2;
    }

    static List<Point> counterClockwise(List<Point> polygon) {
        if (signedArea(polygon) >= 0) {
            return polygon;
        }
        var turned = new ArrayList<>(polygon);
        Collections.reverse(turned);
        return turned;
    }

    /** Twice the signed area of the triangle: positive if c lies to the left of the line from a to b. */
    static double turn(Point a, Point b, Point c) {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    }

    static double distance(Point a, Point b) {
        return StrictMath.hypot(b.x() - a.x(), b.y() - a.y());
    }

    /** True if the path a, b, c turns left by more than rounding: b lies off the line from a to c. */
    static boolean turnsLeft(Point a, Point b, Point c) {
        return turn(a, b, c) > SAME_PLACE_M * distance(a, c);
    }

    /** True if two segments have a common point. */
    static boolean meet(Point a, Point b, Point c, Point d) {
        double abc = turn(a, b, c);
        double abd = turn(a, b, d);
        double cda = turn(c, d, a);
        double cdb = turn(c, d, b);
        if (differ(abc, abd) && differ(cda, cdb)) {
            return true;
        }
        return abc == 0 && between(a, b, c)
                || abd == 0 && between(a, b, d)
                || cda == 0 && between(c, d, a)
                || cdb == 0 && between(c, d, b);
    }

    private static boolean differ(double one, double other) {
        return one > 0 && other < 0 || one < 0 && other > 0;
    }

    private static boolean between(Point a, Point b, Point onLine) {
        return Math.min(a.x(), b.x()) <= onLine.x()
                && onLine.x() <= Math.max(a.x(), b.x())
                && Math.min(a.y(), b.y()) <= onLine.y()
                && onLine.y() <= Math.max(a.y(), b.y());
    }

    /**
     * True if the interiors of two convex polygons have a common point (separating axes); touching is not overlapping.
     */
    static boolean overlap(List<Point> one, List<Point> other) {
        return !hasGapBeyondEdge(one, other) && !hasGapBeyondEdge(other, one);
    }

    /** True if an edge of the first polygon, which is counter-clockwise, has all of the second on its outer side. */
    private static boolean hasGapBeyondEdge(List<Point> polygon, List<Point> other) {
        Point a = polygon.getLast();
        for (Point b : polygon) {
            double deepest = Double.NEGATIVE_INFINITY;
            for (Point p : other) {
                deepest = Math.max(deepest, turn(a, b, p));
            }
            if (deepest <= TOUCHING_M * distance(a, b)) {
                return true;
            }
            a = b;
        }
        return false;
    }
}
