package io.troupe.sim.device;

import io.troupe.sim.scenario.OdometryError;
import io.troupe.sim.scenario.Pose;

/**
 * A robot's odometry, counted from wherever it was last set: exact, or off by a fixed proportion of every move.
 *
 * <p>Exact odometry follows from where the robot is, so it notices when somebody puts the robot elsewhere (Stage's
 * {@code gps}); the other kind counts only what the robot drives (Stage's {@code odom}).
 *
 * <p><b>Threads.</b> One thread at a time. <b>Cost.</b> {@link #sense} allocates nothing.
 */
public final class Position2d {
    /**
     * Metres or radians to which odometry can be set: sums with larger ones are coarser than a micrometre, and some are
     * infinite.
     */
    public static final double FARTHEST = 1e9;

    private static final double FULL_TURN_RAD = 2 * StrictMath.PI;

    private final OdometryError error;
    private final boolean exact;
    private Pose origin; // exact: of the odometry frame, in the world
    private double cos; // of its heading
    private double sin;
    private double seenX; // where the robot was last, in the world
    private double seenY;
    private double seenHeadingRad;
    private double x; // what is reported
    private double y;
    private double headingRad;

    /** Exact odometry that reports this pose while the robot stands where it stands. */
    public Position2d(Pose truth, Pose reported) {
        this(truth, reported, OdometryError.NONE);
    }

    /**
     * The same with errors.
     *
     * @param error this run's error itself, no longer a bound: 0.01 counts 1 % too much
     */
    public Position2d(Pose truth, Pose reported, OdometryError error) {
        this.error = error;
        exact = error.equals(OdometryError.NONE);
        origin = originFor(truth, reported);
        set(truth, reported);
    }

    /** Whether odometry can be set to that: finite numbers, none beyond {@link #FARTHEST}. */
    public static boolean canReport(Pose pose) {
        return Math.abs(pose.x()) <= FARTHEST
                && Math.abs(pose.y()) <= FARTHEST
                && Math.abs(pose.headingRad()) <= FARTHEST;
    }

    /** Makes odometry report this pose while the robot stands where it stands. */
    public void set(Pose truth, Pose reported) {
        origin = originFor(truth, reported);
        cos = StrictMath.cos(origin.headingRad());
        sin = StrictMath.sin(origin.headingRad());
        x = reported.x();
        y = reported.y();
        headingRad = wrap(reported.headingRad());
        seenX = truth.x();
        seenY = truth.y();
        seenHeadingRad = truth.headingRad();
        if (exact) {
            report(seenX, seenY, seenHeadingRad);
        }
    }

    /** Tells that somebody has put the robot elsewhere. */
    public void teleported(Pose to) {
        if (exact) {
            sense(to.x(), to.y(), to.headingRad());
        } else {
            set(to, reported());
        }
    }

    /** Tells where the robot is now, in the world. */
    public void sense(double worldX, double worldY, double worldHeadingRad) {
        if (exact) {
            report(worldX, worldY, worldHeadingRad);
        } else {
            count(worldX, worldY, worldHeadingRad);
        }
        seenX = worldX;
        seenY = worldY;
        seenHeadingRad = worldHeadingRad;
    }

    private void report(double worldX, double worldY, double worldHeadingRad) {
        x = cos * (worldX - origin.x()) + sin * (worldY - origin.y());
        y = cos * (worldY - origin.y()) - sin * (worldX - origin.x());
        headingRad = wrap(worldHeadingRad - origin.headingRad());
    }

    private void count(double worldX, double worldY, double worldHeadingRad) {
        double dx = worldX - seenX;
        double dy = worldY - seenY;
        double cosBefore = StrictMath.cos(seenHeadingRad);
        double sinBefore = StrictMath.sin(seenHeadingRad);
        double forwardM = (cosBefore * dx + sinBefore * dy) * (1 + error.x());
        double leftM = (cosBefore * dy - sinBefore * dx) * (1 + error.y());
        double turnedRad = wrap(worldHeadingRad - seenHeadingRad) * (1 + error.heading());
        double cosReported = StrictMath.cos(headingRad);
        double sinReported = StrictMath.sin(headingRad);
        x += cosReported * forwardM - sinReported * leftM;
        y += sinReported * forwardM + cosReported * leftM;
        headingRad = wrap(headingRad + turnedRad);
    }

    public double x() {
        return x;
    }

    public double y() {
        return y;
    }

    /** From -pi to pi. */
    public double headingRad() {
        return headingRad;
    }

    /** What odometry reports where the robot was seen last. */
    public Pose reported() {
        return new Pose(x, y, headingRad);
    }

    private static Pose originFor(Pose truth, Pose reported) {
        double headingRad = truth.headingRad() - reported.headingRad();
        Pose turned = new Pose(0, 0, headingRad).compose(reported);
        return new Pose(truth.x() - turned.x(), truth.y() - turned.y(), headingRad);
    }

    private static double wrap(double angleRad) {
        // between the bounds the remainder is the angle itself
        return Math.abs(angleRad) < StrictMath.PI ? angleRad : StrictMath.IEEEremainder(angleRad, FULL_TURN_RAD);
    }
}
