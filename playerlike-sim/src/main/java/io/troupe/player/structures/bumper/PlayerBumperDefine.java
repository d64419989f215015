package io.troupe.player.structures.bumper;

import io.troupe.player.structures.PlayerPose3d;

/** Part of a message of the Player interface bumper. */
public class PlayerBumperDefine {
    private PlayerPose3d pose = new PlayerPose3d();
    private float length;
    private float radius;

    public synchronized PlayerPose3d getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose3d value) {
        pose = value;
    }

    public synchronized float getLength() {
        return length;
    }

    public synchronized void setLength(float value) {
        length = value;
    }

    public synchronized float getRadius() {
        return radius;
    }

    public synchronized void setRadius(float value) {
        radius = value;
    }
}
