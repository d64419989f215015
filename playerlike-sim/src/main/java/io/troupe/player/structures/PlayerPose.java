package io.troupe.player.structures;

/** The same as {@link PlayerPose2d}, by the name that older programs use. */
public class PlayerPose extends PlayerPose2d {
    public PlayerPose() {}

    public PlayerPose(double x, double y, double a) {
        super(x, y, a);
    }
}
