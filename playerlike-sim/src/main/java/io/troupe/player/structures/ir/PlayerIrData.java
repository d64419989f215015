package io.troupe.player.structures.ir;

/** Data of the Player interface ir. This client does not use it. */
public class PlayerIrData {
    private int voltages_count;
    private float[] voltages = new float[0];
    private int ranges_count;
    private float[] ranges = new float[0];

    public synchronized int getVoltages_count() {
        return voltages_count;
    }

    public synchronized void setVoltages_count(int value) {
        voltages_count = value;
    }

    public synchronized float[] getVoltages() {
        return voltages;
    }

    public synchronized void setVoltages(float[] value) {
        voltages = value;
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
}
