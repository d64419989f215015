package io.troupe.player.wire;

/** A position and orientation in 3D: metres, radians. */
public record Pose3d(double x, double y, double z, double roll, double pitch, double yaw) {
    /** A pose on the ground plane. */
    public static Pose3d flat(double x, double y, double yaw) {
        return new Pose3d(x, y, 0, 0, 0, yaw);
    }
}
