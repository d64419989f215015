package io.troupe.sim.model;

/**
 * A position and a heading in the plane.
 *
 * <p><b>Units and shapes.</b> Metres; heading in radians, counter-clockwise, 0 along x; the frame depends on the owner.
 */
public record Pose(double x, double y, double headingRad) {
    public static final Pose ORIGIN = new Pose(0, 0, 0);

    /** Converts a pose in this pose's frame to the outer frame. */
    public Pose compose(Pose local) {
        double cos = StrictMath.cos(headingRad);
        double sin = StrictMath.sin(headingRad);
        return new Pose(
                x + cos * local.x - sin * local.y, y + sin * local.x + cos * local.y, headingRad + local.headingRad);
    }

    /** Converts a point in this pose's frame to the outer frame. */
    public Point place(Point local) {
        double cos = StrictMath.cos(headingRad);
        double sin = StrictMath.sin(headingRad);
        return new Point(x + cos * local.x() - sin * local.y(), y + sin * local.x() + cos * local.y());
    }
}
