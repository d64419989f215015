package io.troupe.player.structures.limb;

/** A setting or a question of an arm; no device here uses it. */
public class PlayerLimbPowerReq {
    private byte value;

    public synchronized byte getValue() {
        return value;
    }

    public synchronized void setValue(byte value) {
        value = value;
    }
}
