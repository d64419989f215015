package io.troupe.player.structures.ranger;

/** A setting or a question of the ranger interface, by its name in the original client. */
public class PlayerRangerPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
