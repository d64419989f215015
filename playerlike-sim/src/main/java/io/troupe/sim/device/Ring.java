package io.troupe.sim.device;

import io.troupe.sim.model.Point;
import java.util.List;

/** A closed line around a body, counter-clockwise, that can be moved without allocation. */
sealed class Ring permits ConvexPolygon {
    private final double[] localX;
    private final double[] localY;
    final double[] x;
    final double[] y;
    double minX;
    double minY;
    double maxX;
    double maxY;

    Ring(List<Point> vertices) {
        localX = vertices.stream().mapToDouble(Point::x).toArray();
        localY = vertices.stream().mapToDouble(Point::y).toArray();
        x = new double[localX.length];
        y = new double[localX.length];
    }

    /** Moves the line; the heading is given by its cosine and sine. */
    final void place(double poseX, double poseY, double cos, double sin) {
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

    /** Distance of the farthest vertex from a point. */
    final double radiusM(double fromX, double fromY) {
        double farthestM = 0;
        for (int i = 0; i < x.length; i++) {
            farthestM = Math.max(farthestM, StrictMath.hypot(x[i] - fromX, y[i] - fromY));
        }
        return farthestM;
    }

    final int next(int vertex) {
        return vertex + 1 == x.length ? 0 : vertex + 1;
    }
}
