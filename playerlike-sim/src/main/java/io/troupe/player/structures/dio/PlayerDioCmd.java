package io.troupe.player.structures.dio;

/** A command of the Player interface dio. This client does not use it. */
public class PlayerDioCmd {
    private int count;
    private int digout;

    public synchronized int getCount() {
        return count;
    }

    public synchronized void setCount(int value) {
        count = value;
    }

    public synchronized int getDigout() {
        return digout;
    }

    public synchronized void setDigout(int value) {
        digout = value;
    }
}
