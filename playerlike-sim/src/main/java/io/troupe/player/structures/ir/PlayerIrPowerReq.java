package io.troupe.player.structures.ir;

/** A setting or a question of infrared sensors; no device here uses it. */
public class PlayerIrPowerReq {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
