package io.troupe.player.structures.imu;

import io.troupe.player.structures.PlayerPose3d;

/** Part of a message of the Player interface imu. This client does not use it. */
public class PlayerIMUDataState {
    private PlayerPose3d pose = new PlayerPose3d();

    public synchronized PlayerPose3d getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose3d value) {
        pose = value;
    }
}
