package io.troupe.player.structures.log;

/** A part of the messages of a recorder; no device here uses it. */
public class PlayerLogSetWriteState {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
