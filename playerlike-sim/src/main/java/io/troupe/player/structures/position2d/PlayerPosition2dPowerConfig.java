package io.troupe.player.structures.position2d;

/** A request of the Player interface position2d, named as in the original client. */
public class PlayerPosition2dPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
