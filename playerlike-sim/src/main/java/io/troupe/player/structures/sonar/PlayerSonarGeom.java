package io.troupe.player.structures.sonar;

import io.troupe.player.structures.PlayerPose3d;

/** The poses of the sonars, in the robot's frame. */
public class PlayerSonarGeom {
    private int poses_count;
    private PlayerPose3d[] poses = new PlayerPose3d[0];

    public synchronized int getPoses_count() {
        return poses_count;
    }

    public synchronized void setPoses_count(int value) {
        poses_count = value;
    }

    public synchronized PlayerPose3d[] getPoses() {
        return poses;
    }

    public synchronized void setPoses(PlayerPose3d[] value) {
        poses = value;
    }
}
