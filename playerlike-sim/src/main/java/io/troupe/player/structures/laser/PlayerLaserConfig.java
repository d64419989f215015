package io.troupe.player.structures.laser;

/** Scan configuration of a laser: radians, metres, hertz; with intensity 1 scans contain intensities. */
public class PlayerLaserConfig {
    private float min_angle;
    private float max_angle;
    private float resolution;
    private float max_range;
    private float range_res;
    private byte intensity;
    private float scanning_frequency;

    public synchronized float getMin_angle() {
        return min_angle;
    }

    public synchronized void setMin_angle(float value) {
        min_angle = value;
    }

    public synchronized float getMax_angle() {
        return max_angle;
    }

    public synchronized void setMax_angle(float value) {
        max_angle = value;
    }

    public synchronized float getResolution() {
        return resolution;
    }

    public synchronized void setResolution(float value) {
        resolution = value;
    }

    public synchronized float getMax_range() {
        return max_range;
    }

    public synchronized void setMax_range(float value) {
        max_range = value;
    }

    public synchronized float getRange_res() {
        return range_res;
    }

    public synchronized void setRange_res(float value) {
        range_res = value;
    }

    public synchronized byte getIntensity() {
        return intensity;
    }

    public synchronized void setIntensity(byte value) {
        intensity = value;
    }

    public synchronized float getScanning_frequency() {
        return scanning_frequency;
    }

    public synchronized void setScanning_frequency(float value) {
        scanning_frequency = value;
    }
}
