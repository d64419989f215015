package io.troupe.player.structures.log;

/** Part of a message of the Player interface log. This client does not use it. */
public class PlayerLogGetState {
    private byte type;
    private byte state;

    public synchronized byte getType() {
        return type;
    }

    public synchronized void setType(byte value) {
        type = value;
    }

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
