package io.troupe.sim.model;

/**
 * Bounds of the odometry error. For each run and robot, one factor for each axis is drawn, uniform within plus or minus
 * half of these, and holds for the whole run.
 *
 * <p><b>Source.</b> Stage's {@code odom_error}, whose third number (z) has no meaning here.
 *
 * @param x proportional to forward motion, 0.03 = 3 %
 * @param y proportional to sideways motion
 * @param heading proportional to turns
 */
public record OdometryError(double x, double y, double heading) {
    /** Exact odometry. */
    public static final OdometryError NONE = new OdometryError(0, 0, 0);

    /** Stage's default. */
    public static final OdometryError STAGE = new OdometryError(0.03, 0.03, 0.05);
}
