package io.troupe.sim.scenario;

/**
 * Where something is and which way it faces.
 *
 * <p><b>Units and shapes.</b> Metres; heading in radians, counter-clockwise, 0 along x; the frame is the owner's.
 */
public record Pose(double x, double y, double headingRad) {
    public static final Pose ORIGIN = new Pose(0, 0, 0);

    /** The pose in the outer frame of one given in this pose's frame. */
    public Pose compose(Pose local) {
        double cos = StrictMath.cos(headingRad);
        double sin = StrictMath.sin(headingRad);
        return new Pose(
                x + cos * local.x - sin * local.y, y + sin * local.x + cos * local.y, headingRad + local.headingRad);
    }

    /** The point in the outer frame of one given in this pose's frame. */
    public Point place(Point local) {
        double cos = StrictMath.cos(headingRad);
        double sin = StrictMath.sin(headingRad);
        return new Point(x + cos * local.x() - sin * local.y(), y + sin * local.x() + cos * local.y());
    }
}
