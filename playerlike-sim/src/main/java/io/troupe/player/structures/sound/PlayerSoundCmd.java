package io.troupe.player.structures.sound;

/** A command of the Player interface sound. This client does not use it. */
public class PlayerSoundCmd {
    private int index;

    public synchronized int getIndex() {
        return index;
    }

    public synchronized void setIndex(int value) {
        index = value;
    }
}
