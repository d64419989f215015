package io.troupe.sim.device;

import io.troupe.sim.model.Point;
import java.util.List;

/** A convex polygon, counter-clockwise, that can be moved without allocation. */
final class ConvexPolygon extends Ring {
    /** Polygons that overlap by no more than this depth only touch. */
    private static final double TOUCH_M = 1e-9;

    ConvexPolygon(List<Point> vertices) {
        super(vertices);
    }

    boolean overlaps(ConvexPolygon other) {
        boolean far = other.minX > maxX || minX > other.maxX || other.minY > maxY || minY > other.maxY;
        return !far && !separatedByAnEdgeOf(this, other) && !separatedByAnEdgeOf(other, this);
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

    /** Lower bound of the distance to the other polygon, from the bounding boxes. */
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
