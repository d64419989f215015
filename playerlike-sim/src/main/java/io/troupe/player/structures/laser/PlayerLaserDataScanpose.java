package io.troupe.player.structures.laser;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** A scan with the robot's pose at that time. */
public class PlayerLaserDataScanpose {
    private PlayerLaserData scan = new PlayerLaserData();
    private PlayerPose pose = new PlayerPose();

    public synchronized PlayerLaserData getScan() {
        return scan;
    }

    public synchronized void setScan(PlayerLaserData value) {
        scan = value;
    }

    public synchronized PlayerPose getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose2d value) {
        pose = PlayerPose.of(value);
    }
}
