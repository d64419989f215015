package io.troupe.player.structures.laser;

import io.troupe.player.structures.PlayerBbox3d;
import io.troupe.player.structures.PlayerPose3d;

/** Pose and size of a laser, in the robot's frame. */
public class PlayerLaserGeom {
    private PlayerPose3d pose = new PlayerPose3d();
    private PlayerBbox3d size = new PlayerBbox3d();

    public synchronized PlayerPose3d getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose3d value) {
        pose = value;
    }

    public synchronized PlayerBbox3d getSize() {
        return size;
    }

    public synchronized void setSize(PlayerBbox3d value) {
        size = value;
    }
}
