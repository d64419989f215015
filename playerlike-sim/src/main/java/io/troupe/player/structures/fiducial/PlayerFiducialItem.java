package io.troupe.player.structures.fiducial;

import io.troupe.player.structures.PlayerPose3d;

/** Part of a message of the Player interface fiducial. */
public class PlayerFiducialItem {
    private int id;
    private PlayerPose3d pose = new PlayerPose3d();
    private PlayerPose3d upose = new PlayerPose3d();

    public synchronized int getId() {
        return id;
    }

    public synchronized void setId(int value) {
        id = value;
    }

    public synchronized PlayerPose3d getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose3d value) {
        pose = value;
    }

    public synchronized PlayerPose3d getUpose() {
        return upose;
    }

    public synchronized void setUpose(PlayerPose3d value) {
        upose = value;
    }
}
