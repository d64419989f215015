package io.troupe.player.structures.position3d;

/** A request of the Player interface position3d. This client does not use it. */
public class PlayerPosition3dPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
