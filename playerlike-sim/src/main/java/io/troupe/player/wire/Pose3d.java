package io.troupe.player.wire;

/** A place and how something is turned there: metres, radians. */
public record Pose3d(double x, double y, double z, double roll, double pitch, double yaw) {
    /** On the ground. */
    public static Pose3d flat(double x, double y, double yaw) {
        return new Pose3d(x, y, 0, 0, 0, yaw);
    }
}
