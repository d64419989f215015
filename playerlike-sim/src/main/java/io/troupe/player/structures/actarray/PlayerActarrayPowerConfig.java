package io.troupe.player.structures.actarray;

/** A setting or a question of an array of actuators; no device here uses it. */
public class PlayerActarrayPowerConfig {
    private byte value;

    public synchronized byte getValue() {
        return value;
    }

    public synchronized void setValue(byte value) {
        value = value;
    }
}
