package io.troupe.player.structures.dio;

/** Data of the Player interface dio. This client does not use it. */
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
