package io.troupe.player.structures.position3d;

/** A setting or a question of a robot that moves in space; no device here uses it. */
public class PlayerPosition3dPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
