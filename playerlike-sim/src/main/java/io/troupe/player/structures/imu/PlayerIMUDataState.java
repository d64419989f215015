package io.troupe.player.structures.imu;

import io.troupe.player.structures.PlayerPose3d;

/** A part of the messages of an inertial sensor; no device here uses it. */
public class PlayerIMUDataState {
    private PlayerPose3d pose = new PlayerPose3d();

    public synchronized PlayerPose3d getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose3d value) {
        pose = value;
    }
}
