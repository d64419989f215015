package io.troupe.player.structures.imu;

/** A part of the messages of an inertial sensor; no device here uses it. */
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
