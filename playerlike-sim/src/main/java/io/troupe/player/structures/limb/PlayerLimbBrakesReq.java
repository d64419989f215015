package io.troupe.player.structures.limb;

/** A request of the Player interface limb. This client does not use it. */
public class PlayerLimbBrakesReq {
    private byte value;

    public synchronized byte getValue() {
        return value;
    }

    public synchronized void setValue(byte value) {
        value = value;
    }
}
