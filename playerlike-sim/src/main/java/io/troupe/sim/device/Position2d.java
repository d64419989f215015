package io.troupe.sim.device;

import io.troupe.sim.scenario.OdometryError;
import io.troupe.sim.scenario.Pose;

/**
 * A robot's odometry, counted from wherever it was last set: exact, or off by a fixed proportion of every move.
 *
 * <p>Exact odometry follows from where the robot is, so it notices when somebody puts the robot elsewhere (Stage's {@code gps}); the other kind counts only
 * what the robot drives (Stage's {@code odom}).
 *
 * <p><b>Threads.</b> One thread at a time.
 */
public final class Position2d {
    private static final double FULL_TURN_RAD = 2 * StrictMath.PI;

    private final OdometryError error;
    private final boolean exact;
    private Pose origin; // exact: of the odometry frame, in the world
    private Pose counted; // else: what was reported last
    private Pose countedAt; // and where the robot was

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
        counted = reported;
        countedAt = truth;
    }

    /** Makes odometry report this pose while the robot stands where it stands. */
    public void set(Pose truth, Pose reported) {
        origin = originFor(truth, reported);
        counted = reported;
        countedAt = truth;
    }

    /** Tells that somebody has put the robot elsewhere. */
    public void teleported(Pose from, Pose to) {
        if (!exact) {
            set(to, report(from));
        }
    }

    /** What odometry reports of a robot that is there now; the heading from -pi to pi. */
    public Pose report(Pose truth) {
        return exact ? exactly(truth) : count(truth);
    }

    private Pose exactly(Pose truth) {
        double dx = truth.x() - origin.x();
        double dy = truth.y() - origin.y();
        double cos = StrictMath.cos(origin.headingRad());
        double sin = StrictMath.sin(origin.headingRad());
        return new Pose(cos * dx + sin * dy, cos * dy - sin * dx, wrap(truth.headingRad() - origin.headingRad()));
    }

    private Pose count(Pose truth) {
        double dx = truth.x() - countedAt.x();
        double dy = truth.y() - countedAt.y();
        double cos = StrictMath.cos(countedAt.headingRad());
        double sin = StrictMath.sin(countedAt.headingRad());
        double turnedRad = wrap(truth.headingRad() - countedAt.headingRad());
        Pose moved = counted.compose(new Pose(
                (cos * dx + sin * dy) * (1 + error.x()),
                (cos * dy - sin * dx) * (1 + error.y()),
                turnedRad * (1 + error.heading())));
        counted = new Pose(moved.x(), moved.y(), wrap(moved.headingRad()));
        countedAt = truth;
        return counted;
    }

    private static Pose originFor(Pose truth, Pose reported) {
        double headingRad = truth.headingRad() - reported.headingRad();
        Pose turned = new Pose(0, 0, headingRad).compose(reported);
        return new Pose(truth.x() - turned.x(), truth.y() - turned.y(), headingRad);
    }

    private static double wrap(double angleRad) {
        return StrictMath.IEEEremainder(angleRad, FULL_TURN_RAD);
    }
}
