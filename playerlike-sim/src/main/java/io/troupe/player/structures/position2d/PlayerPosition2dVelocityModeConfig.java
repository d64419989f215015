package io.troupe.player.structures.position2d;

/** A setting or a question of the position2d interface, by its name in the original client. */
public class PlayerPosition2dVelocityModeConfig {
    private int value;

    public synchronized int getValue() {
        return value;
    }

    public synchronized void setValue(int value) {
        value = value;
    }
}
