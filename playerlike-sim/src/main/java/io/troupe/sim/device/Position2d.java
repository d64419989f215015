package io.troupe.sim.device;

import io.troupe.sim.scenario.Pose;

/** A robot's odometry: exact, and counted from wherever it was last set. */
public final class Position2d {
    private Pose origin; // of the odometry frame, in the world
    private double cos;
    private double sin;

    /** Odometry that reports this pose while the robot stands where it stands. */
    public Position2d(Pose truth, Pose reported) {
        origin = originFor(truth, reported);
        turn();
    }

    /** Makes odometry report this pose while the robot stands where it stands. */
    public void set(Pose truth, Pose reported) {
        origin = originFor(truth, reported);
        turn();
    }

    private void turn() {
        cos = StrictMath.cos(origin.headingRad());
        sin = StrictMath.sin(origin.headingRad());
    }

    /** What odometry reports of a robot that stands there; the heading from -pi to pi. */
    public Pose report(Pose truth) {
        return new Pose(x(truth.x(), truth.y()), y(truth.x(), truth.y()), headingRad(truth.headingRad()));
    }

    /** The x that odometry reports of a robot that stands at this point of the world. */
    public double x(double worldX, double worldY) {
        return cos * (worldX - origin.x()) + sin * (worldY - origin.y());
    }

    /** The y that odometry reports of a robot that stands at this point of the world. */
    public double y(double worldX, double worldY) {
        return cos * (worldY - origin.y()) - sin * (worldX - origin.x());
    }

    /** The heading that odometry reports of a robot with this heading in the world; from -pi to pi. */
    public double headingRad(double worldHeadingRad) {
        return StrictMath.IEEEremainder(worldHeadingRad - origin.headingRad(), 2 * StrictMath.PI);
    }

    private static Pose originFor(Pose truth, Pose reported) {
        double headingRad = truth.headingRad() - reported.headingRad();
        Pose turned = new Pose(0, 0, headingRad).compose(reported);
        return new Pose(truth.x() - turned.x(), truth.y() - turned.y(), headingRad);
    }
}
