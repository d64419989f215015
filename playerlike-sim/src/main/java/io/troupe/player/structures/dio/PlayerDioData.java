package io.troupe.player.structures.dio;

/** Data of digital inputs and outputs; no device here uses it. */
public class PlayerDioData {
    private int count;
    private int digin;

    public synchronized int getCount() {
        return count;
    }

    public synchronized void setCount(int value) {
        count = value;
    }

    public synchronized int getDigin() {
        return digin;
    }

    public synchronized void setDigin(int value) {
        digin = value;
    }
}
