package io.troupe.player.structures.laser;

/** A setting or a question of the laser interface, by its name in the original client. */
public class PlayerLaserPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
