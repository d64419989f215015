package io.troupe.player.structures.ranger;

/** Scan configuration of a ranger: radians, metres, hertz; NaN for an unknown value. */
public class PlayerRangerConf {
    private double min_angle = Double.NaN;
    private double max_angle = Double.NaN;
    private double resolution = Double.NaN;
    private double min_range = Double.NaN;
    private double max_range = Double.NaN;
    private double range_res = Double.NaN;
    private double frequency = Double.NaN;

    public synchronized double getMin_angle() {
        return min_angle;
    }

    public synchronized void setMin_angle(double value) {
        min_angle = value;
    }

    public synchronized double getMax_angle() {
        return max_angle;
    }

    public synchronized void setMax_angle(double value) {
        max_angle = value;
    }

    public synchronized double getResolution() {
        return resolution;
    }

    public synchronized void setResolution(double value) {
        resolution = value;
    }

    public synchronized double getMin_range() {
        return min_range;
    }

    public synchronized void setMin_range(double value) {
        min_range = value;
    }

    public synchronized double getMax_range() {
        return max_range;
    }

    public synchronized void setMax_range(double value) {
        max_range = value;
    }

    public synchronized double getRange_res() {
        return range_res;
    }

    public synchronized void setRange_res(double value) {
        range_res = value;
    }

    public synchronized double getFrequency() {
        return frequency;
    }

    public synchronized void setFrequency(double value) {
        frequency = value;
    }
}
