package io.troupe.player.structures.ir;

/** A request of the Player interface ir. This client does not use it. */
public class PlayerIrPowerReq {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
