package io.troupe.player.structures.position1d;

/** A request of the Player interface position1d. This client does not use it. */
public class PlayerPosition1dPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
