package io.troupe.player.structures.position3d;

/** A setting or a question of a robot that moves in space; no device here uses it. */
public class PlayerPosition3dVelocityModeConfig {
    private int value;

    public synchronized int getValue() {
        return value;
    }

    public synchronized void setValue(int value) {
        value = value;
    }
}
