package io.troupe.player.structures.laser;

/** A request of the Player interface laser, named as in the original client. */
public class PlayerLaserPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
