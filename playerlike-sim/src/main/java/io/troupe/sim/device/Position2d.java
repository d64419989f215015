package io.troupe.sim.device;

import io.troupe.sim.model.OdometryError;
import io.troupe.sim.model.Pose;
import io.troupe.sim.numeric.Angles;

/**
 * A robot's odometry since it was last set: exact, or with an error proportional to every move.
 *
 * <p>Exact odometry follows from the true pose, so it includes teleports (Stage's {@code gps}). Odometry with an error
 * sums up only what the robot drives (Stage's {@code odom}).
 *
 * <p><b>Threads.</b> One thread at a time. <b>Cost.</b> {@link #sense} allocates nothing.
 */
public final class Position2d {
    /**
     * Largest value in metres or radians to which odometry can be set. Sums with larger values are coarser than a
     * micrometre, and some are infinite.
     */
    public static final double FARTHEST = 1e9;

    private final OdometryError error;
    private final boolean exact;
    private Pose origin; // exact odometry: origin of the odometry frame, in the world
    private double cos; // of the origin's heading
    private double sin;
    private double seenX; // last true pose, in the world
    private double seenY;
    private double seenHeadingRad;
    private double x; // reported pose
    private double y;
    private double headingRad;

    /** Creates exact odometry that reports the given pose at the robot's current pose. */
    public Position2d(Pose truth, Pose reported) {
        this(truth, reported, OdometryError.NONE);
    }

    /**
     * Creates odometry with an error.
     *
     * @param error the error of this run, not a bound: 0.01 counts 1 % too much
     */
    public Position2d(Pose truth, Pose reported, OdometryError error) {
        this.error = error;
        exact = error.equals(OdometryError.NONE);
        origin = originFor(truth, reported);
        set(truth, reported);
    }

    /** True if odometry can be set to a pose: finite numbers, none beyond {@link #FARTHEST}. */
    public static boolean canReport(Pose pose) {
        return Math.abs(pose.x()) <= FARTHEST
                && Math.abs(pose.y()) <= FARTHEST
                && Math.abs(pose.headingRad()) <= FARTHEST;
    }

    /** Sets the pose that odometry reports at the robot's current pose. */
    public void set(Pose truth, Pose reported) {
        origin = originFor(truth, reported);
        cos = StrictMath.cos(origin.headingRad());
        sin = StrictMath.sin(origin.headingRad());
        x = reported.x();
        y = reported.y();
        headingRad = Angles.wrap(reported.headingRad());
        seenX = truth.x();
        seenY = truth.y();
        seenHeadingRad = truth.headingRad();
        if (exact) {
            report(seenX, seenY, seenHeadingRad);
        }
    }

    /** Handles a teleport of the robot. */
    public void teleported(Pose to) {
        if (exact) {
            sense(to.x(), to.y(), to.headingRad());
        } else {
            set(to, reported());
        }
    }

    /** Updates odometry with the robot's current pose in the world. */
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
        headingRad = Angles.wrap(worldHeadingRad - origin.headingRad());
    }

    private void count(double worldX, double worldY, double worldHeadingRad) {
        double dx = worldX - seenX;
        double dy = worldY - seenY;
        double cosBefore = StrictMath.cos(seenHeadingRad);
        double sinBefore = StrictMath.sin(seenHeadingRad);
        double forwardM = (cosBefore * dx + sinBefore * dy) * (1 + error.x());
        double leftM = (cosBefore * dy - sinBefore * dx) * (1 + error.y());
        double turnedRad = Angles.wrap(worldHeadingRad - seenHeadingRad) * (1 + error.heading());
        double cosReported = StrictMath.cos(headingRad);
        double sinReported = StrictMath.sin(headingRad);
        x += cosReported * forwardM - sinReported * leftM;
        y += sinReported * forwardM + cosReported * leftM;
        headingRad = Angles.wrap(headingRad + turnedRad);
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

    /** Pose that odometry reports for the last known pose of the robot. */
    public Pose reported() {
        return new Pose(x, y, headingRad);
    }

    private static Pose originFor(Pose truth, Pose reported) {
        double headingRad = truth.headingRad() - reported.headingRad();
        Pose turned = new Pose(0, 0, headingRad).compose(reported);
        return new Pose(truth.x() - turned.x(), truth.y() - turned.y(), headingRad);
    }
}
