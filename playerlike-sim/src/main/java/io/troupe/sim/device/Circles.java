package io.troupe.sim.device;

/** For each thing a circle that holds it. */
final class Circles {
    final double[] x;
    final double[] y;
    final double[] radiusM;

    Circles(int things) {
        x = new double[things];
        y = new double[things];
        radiusM = new double[things];
    }

    /** A circle around this point that holds the outline; a thing without polygons gets an empty one. */
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
