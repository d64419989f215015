package io.troupe.player.structures.imu;

import io.troupe.player.structures.PlayerOrientation3d;

/** Part of a message of the Player interface imu. This client does not use it. */
public class PlayerIMUDataEuler {
    private PlayerIMUDataCalib calib_data = new PlayerIMUDataCalib();
    private PlayerOrientation3d quaternions = new PlayerOrientation3d();

    public synchronized PlayerIMUDataCalib getCalib_data() {
        return calib_data;
    }

    public synchronized void setCalib_data(PlayerIMUDataCalib value) {
        calib_data = value;
    }

    public synchronized PlayerOrientation3d getQuaternions() {
        return quaternions;
    }

    public synchronized void setQuaternions(PlayerOrientation3d value) {
        quaternions = value;
    }
}
