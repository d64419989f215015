package io.troupe.player.structures;

/** The same as {@link PlayerPose2d}, under the name that older programs use. */
public class PlayerPose extends PlayerPose2d {
    public PlayerPose() {}

    public PlayerPose(double x, double y, double a) {
        super(x, y, a);
    }

    /** Returns the argument if it already has the older type, else a copy of that type. */
    public static PlayerPose of(PlayerPose2d pose) {
        return pose instanceof PlayerPose same ? same : new PlayerPose(pose.getPx(), pose.getPy(), pose.getPa());
    }
}
