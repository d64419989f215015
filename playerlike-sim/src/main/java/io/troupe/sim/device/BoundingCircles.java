package io.troupe.sim.device;

/** A bounding circle for each thing. */
final class BoundingCircles {
    final double[] x;
    final double[] y;
    final double[] radiusM;

    BoundingCircles(int things) {
        x = new double[things];
        y = new double[things];
        radiusM = new double[things];
    }

    /** Sets a circle around a point that encloses the outline; a thing without polygons gets radius 0. */
    void set(int thing, double centreX, double centreY, Outline outline) {
        x[thing] = centreX;
        y[thing] = centreY;
        double radius = 0;
        for (ConvexPolygon polygon : outline.polygons()) {
            for (int i = 0; i < polygon.x.length; i++) {
                radius = Math.max(radius, StrictMath.hypot(polygon.x[i] - centreX, polygon.y[i] - centreY));
            }
        }
        radiusM[thing] = radius;
    }
}
