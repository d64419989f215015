package io.troupe.sim.device;

import io.troupe.sim.scenario.Pose;

/**
 * A robot's reckoning of where it is, relative to where it was last set.
 *
 * <p><b>Source.</b> Stage's "gps" localization in the classic dialect: exact, in the frame of the start pose.
 */
public final class Odometer {
    private Pose origin;
    private Pose reportedAtOrigin;

    /** Reports {@code reported} while the robot is at {@code truth}. */
    public Odometer(Pose truth, Pose reported) {
        origin = truth;
        reportedAtOrigin = reported;
    }

    /** From now on reports {@code reported} at {@code truth}. */
    public void set(Pose truth, Pose reported) {
        origin = truth;
        reportedAtOrigin = reported;
    }

    /** What it reports when the robot is at {@code truth}. */
    public Pose read(Pose truth) {
        double cos = StrictMath.cos(origin.headingRad());
        double sin = StrictMath.sin(origin.headingRad());
        double dx = truth.x() - origin.x();
        double dy = truth.y() - origin.y();
        var moved = new Pose(cos * dx + sin * dy, cos * dy - sin * dx, truth.headingRad() - origin.headingRad());
        Pose reading = reportedAtOrigin.compose(moved);
        return new Pose(reading.x(), reading.y(), StrictMath.IEEEremainder(reading.headingRad(), 2 * StrictMath.PI));
    }
}
