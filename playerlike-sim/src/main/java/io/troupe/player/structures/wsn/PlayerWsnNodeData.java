package io.troupe.player.structures.wsn;

/** Data of the Player interface wsn. This client does not use it. */
public class PlayerWsnNodeData {
    private float light;
    private float mic;
    private float accel_x;
    private float accel_y;
    private float accel_z;
    private float magn_x;
    private float magn_y;
    private float magn_z;
    private float temperature;
    private float battery;

    public synchronized float getLight() {
        return light;
    }

    public synchronized void setLight(float value) {
        light = value;
    }

    public synchronized float getMic() {
        return mic;
    }

    public synchronized void setMic(float value) {
        mic = value;
    }

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

    public synchronized float getTemperature() {
        return temperature;
    }

    public synchronized void setTemperature(float value) {
        temperature = value;
    }

    public synchronized float getBattery() {
        return battery;
    }

    public synchronized void setBattery(float value) {
        battery = value;
    }
}
