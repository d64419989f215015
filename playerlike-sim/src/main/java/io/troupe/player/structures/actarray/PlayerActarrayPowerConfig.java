package io.troupe.player.structures.actarray;

/** A request of the Player interface actarray. This client does not use it. */
public class PlayerActarrayPowerConfig {
    private byte value;

    public synchronized byte getValue() {
        return value;
    }

    public synchronized void setValue(byte value) {
        value = value;
    }
}
