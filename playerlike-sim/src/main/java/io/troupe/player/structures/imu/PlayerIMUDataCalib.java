package io.troupe.player.structures.imu;

/** Part of a message of the Player interface imu. This client does not use it. */
public class PlayerIMUDataCalib {
    private float accel_x;
    private float accel_y;
    private float accel_z;
    private float gyro_x;
    private float gyro_y;
    private float gyro_z;
    private float magn_x;
    private float magn_y;
    private float magn_z;

    public synchronized float getAccel_x() {
        return accel_x;
    }

    public synchronized void setAccel_x(float value) {
        accel_x = value;
    }

    public synchronized float getAccel_y() {
        return accel_y;
    }

    public synchronized void setAccel_y(float value) {
        accel_y = value;
    }

    public synchronized float getAccel_z() {
        return accel_z;
    }

    public synchronized void setAccel_z(float value) {
        accel_z = value;
    }

    public synchronized float getGyro_x() {
        return gyro_x;
    }

    public synchronized void setGyro_x(float value) {
        gyro_x = value;
    }

    public synchronized float getGyro_y() {
        return gyro_y;
    }

    public synchronized void setGyro_y(float value) {
        gyro_y = value;
    }

    public synchronized float getGyro_z() {
        return gyro_z;
    }

    public synchronized void setGyro_z(float value) {
        gyro_z = value;
    }

    public synchronized float getMagn_x() {
        return magn_x;
    }

    public synchronized void setMagn_x(float value) {
        magn_x = value;
    }

    public synchronized float getMagn_y() {
        return magn_y;
    }

    public synchronized void setMagn_y(float value) {
        magn_y = value;
    }

    public synchronized float getMagn_z() {
        return magn_z;
    }

    public synchronized void setMagn_z(float value) {
        magn_z = value;
    }
}
