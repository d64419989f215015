package io.troupe.sim.device;

import io.troupe.sim.scenario.Pose;

/** A robot's odometry: exact, and counted from wherever it was last set. */
public final class Position2d {
    private Pose origin; // of the odometry frame, in the world

    /** Odometry that reports this pose while the robot stands where it stands. */
    public Position2d(Pose truth, Pose reported) {
        origin = originFor(truth, reported);
    }

    /** Makes odometry report this pose while the robot stands where it stands. */
    public void set(Pose truth, Pose reported) {
        origin = originFor(truth, reported);
    }

    /** What odometry reports of a robot that stands there; the heading from -pi to pi. */
    public Pose report(Pose truth) {
        double dx = truth.x() - origin.x();
        double dy = truth.y() - origin.y();
        double cos = StrictMath.cos(origin.headingRad());
        double sin = StrictMath.sin(origin.headingRad());
        double headingRad = StrictMath.IEEEremainder(truth.headingRad() - origin.headingRad(), 2 * StrictMath.PI);
        return new Pose(cos * dx + sin * dy, cos * dy - sin * dx, headingRad);
    }

    private static Pose originFor(Pose truth, Pose reported) {
        double headingRad = truth.headingRad() - reported.headingRad();
        Pose turned = new Pose(0, 0, headingRad).compose(reported);
        return new Pose(truth.x() - turned.x(), truth.y() - turned.y(), headingRad);
    }
}
