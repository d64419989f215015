package io.troupe.player.structures.laser;

import io.troupe.player.structures.PlayerPoint2d;

/**
 * A scan from the least angle (right) to the greatest (left): radians and metres. The points are in the laser's frame.
 */
public class PlayerLaserData {
    private float min_angle;
    private float max_angle;
    private float resolution;
    private float max_range;
    private int ranges_count;
    private float[] ranges = new float[0];
    private int intensity_count;
    private byte[] intensity = new byte[0];
    private int id;
    private PlayerPoint2d[] points = new PlayerPoint2d[0];

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

    public synchronized int getRanges_count() {
        return ranges_count;
    }

    public synchronized void setRanges_count(int value) {
        ranges_count = value;
    }

    public synchronized float[] getRanges() {
        return ranges;
    }

    public synchronized void setRanges(float[] value) {
        ranges = value;
    }

    public synchronized int getIntensity_count() {
        return intensity_count;
    }

    public synchronized void setIntensity_count(int value) {
        intensity_count = value;
    }

    public synchronized byte[] getIntensity() {
        return intensity;
    }

    public synchronized void setIntensity(byte[] value) {
        intensity = value;
    }

    public synchronized int getId() {
        return id;
    }

    public synchronized void setId(int value) {
        id = value;
    }

    public synchronized PlayerPoint2d[] getPoints() {
        return points;
    }

    public synchronized void setPoints(PlayerPoint2d[] value) {
        points = value;
    }
}
