package io.troupe.player.structures;

/** The same as {@link PlayerPose2d}, by the name that older programs use. */
public class PlayerPose extends PlayerPose2d {
    public PlayerPose() {}

    public PlayerPose(double x, double y, double a) {
        super(x, y, a);
    }

    /** The pose itself where it has the older name already, else a copy that has. */
    public static PlayerPose of(PlayerPose2d pose) {
        return pose instanceof PlayerPose same ? same : new PlayerPose(pose.getPx(), pose.getPy(), pose.getPa());
    }
}
