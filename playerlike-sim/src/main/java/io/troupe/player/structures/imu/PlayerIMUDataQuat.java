package io.troupe.player.structures.imu;

/** Part of a message of the Player interface imu. This client does not use it. */
public class PlayerIMUDataQuat {
    private PlayerIMUDataCalib calib_data = new PlayerIMUDataCalib();
    private float[] quaternions = new float[0];

    public synchronized PlayerIMUDataCalib getCalib_data() {
        return calib_data;
    }

    public synchronized void setCalib_data(PlayerIMUDataCalib value) {
        calib_data = value;
    }

    public synchronized float[] getQuaternions() {
        return quaternions;
    }

    public synchronized void setQuaternions(float[] value) {
        quaternions = value;
    }
}
