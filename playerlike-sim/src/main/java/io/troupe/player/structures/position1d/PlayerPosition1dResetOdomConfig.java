package io.troupe.player.structures.position1d;

/** A request of the Player interface position1d. This client does not use it. */
public class PlayerPosition1dResetOdomConfig {
    private int value;

    public synchronized int getValue() {
        return value;
    }

    public synchronized void setValue(int value) {
        value = value;
    }
}
