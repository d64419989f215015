package io.troupe.player.structures.ranger;

/** A request of the Player interface ranger, named as in the original client. */
public class PlayerRangerPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
