package io.troupe.player.structures.log;

/** Part of a message of the Player interface log. This client does not use it. */
public class PlayerLogSetReadState {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
