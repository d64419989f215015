package io.troupe.player.structures.position1d;

/** A setting or a question of a linear actuator; no device here uses it. */
public class PlayerPosition1dPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
