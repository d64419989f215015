package io.troupe.sim.scenario;

/**
 * By how much odometry may miscount: for each run and robot one factor is drawn for each, evenly from plus or minus
 * half of these, and holds for the whole run.
 *
 * <p><b>Source.</b> Stage's {@code odom_error}, whose third number (z) has no meaning here.
 *
 * @param x proportional to what it drives forwards, 0.03 = 3 %
 * @param y proportional to what it is pushed sideways
 * @param heading proportional to what it turns
 */
public record OdometryError(double x, double y, double heading) {
    /** Exact odometry. */
    public static final OdometryError NONE = new OdometryError(0, 0, 0);

    /** What Stage has where the file says nothing. */
    public static final OdometryError STAGE = new OdometryError(0.03, 0.03, 0.05);
}
