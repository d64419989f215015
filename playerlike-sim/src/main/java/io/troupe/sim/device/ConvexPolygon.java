package io.troupe.sim.device;

import io.troupe.sim.scenario.Point;
import java.util.List;

/** One convex polygon, counter-clockwise, that can be moved without allocating. */
final class ConvexPolygon {
    /** Polygons that reach into each other no deeper than this merely touch. */
    private static final double TOUCH_M = 1e-9;

    private final double[] localX;
    private final double[] localY;
    final double[] x;
    final double[] y;
    double minX;
    double minY;
    double maxX;
    double maxY;

    ConvexPolygon(List<Point> vertices) {
        localX = vertices.stream().mapToDouble(Point::x).toArray();
        localY = vertices.stream().mapToDouble(Point::y).toArray();
        x = new double[localX.length];
        y = new double[localX.length];
    }

    void place(double poseX, double poseY, double cos, double sin) {
        minX = minY = Double.POSITIVE_INFINITY;
        maxX = maxY = Double.NEGATIVE_INFINITY;
        for (int i = 0; i < x.length; i++) {
            x[i] = poseX + cos * localX[i] - sin * localY[i];
            y[i] = poseY + sin * localX[i] + cos * localY[i];
            minX = Math.min(minX, x[i]);
            minY = Math.min(minY, y[i]);
            maxX = Math.max(maxX, x[i]);
            maxY = Math.max(maxY, y[i]);
        }
    }

    int next(int vertex) {
        return vertex + 1 == x.length ? 0 : vertex + 1;
    }

    boolean overlaps(ConvexPolygon other) {
        return !separatedByAnEdgeOf(this, other) && !separatedByAnEdgeOf(other, this);
    }

    private static boolean separatedByAnEdgeOf(ConvexPolygon a, ConvexPolygon b) {
        for (int i = 0; i < a.x.length; i++) {
            int j = a.next(i);
            double edgeX = a.x[j] - a.x[i];
            double edgeY = a.y[j] - a.y[i];
            double nearest = Double.POSITIVE_INFINITY;
            for (int k = 0; k < b.x.length; k++) {
                nearest = Math.min(nearest, edgeY * (b.x[k] - a.x[i]) - edgeX * (b.y[k] - a.y[i]));
            }
            if (nearest >= -TOUCH_M * Math.sqrt(edgeX * edgeX + edgeY * edgeY)) {
                return true;
            }
        }
        return false;
    }

    /** No point of the other polygon is nearer than this. */
    double gapAtLeast(ConvexPolygon other) {
        double dx = Math.max(0, Math.max(other.minX - maxX, minX - other.maxX));
        double dy = Math.max(0, Math.max(other.minY - maxY, minY - other.maxY));
        return Math.sqrt(dx * dx + dy * dy);
    }

    /** Shortest distance; 0 if they touch or overlap. */
    double gap(ConvexPolygon other) {
        if (overlaps(other)) {
            return 0;
        }
        return Math.sqrt(Math.min(squareFromVertices(this, other), squareFromVertices(other, this)));
    }

    private static double squareFromVertices(ConvexPolygon vertices, ConvexPolygon edges) {
        double least = Double.POSITIVE_INFINITY;
        for (int i = 0; i < edges.x.length; i++) {
            int j = edges.next(i);
            double edgeX = edges.x[j] - edges.x[i];
            double edgeY = edges.y[j] - edges.y[i];
            double lengthSquare = edgeX * edgeX + edgeY * edgeY;
            for (int k = 0; k < vertices.x.length; k++) {
                double dx = vertices.x[k] - edges.x[i];
                double dy = vertices.y[k] - edges.y[i];
                double along = Math.clamp((dx * edgeX + dy * edgeY) / lengthSquare, 0.0, 1.0);
                dx -= along * edgeX;
                dy -= along * edgeY;
                least = Math.min(least, dx * dx + dy * dy);
            }
        }
        return least;
    }
}
