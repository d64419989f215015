package io.troupe.player.structures.position1d;

/** A setting or a question of a linear actuator; no device here uses it. */
public class PlayerPosition1dResetOdomConfig {
    private int value;

    public synchronized int getValue() {
        return value;
    }

    public synchronized void setValue(int value) {
        value = value;
    }
}
