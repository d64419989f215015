package io.troupe.player.structures.aio;

/** Data of the Player interface aio. This client does not use it. */
public class PlayerAioData {
    private int voltages_count;
    private float[] voltages = new float[0];

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
}
