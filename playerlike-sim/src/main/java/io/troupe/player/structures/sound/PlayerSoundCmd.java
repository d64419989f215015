package io.troupe.player.structures.sound;

/** A command of sound clips; no device here uses it. */
public class PlayerSoundCmd {
    private int index;

    public synchronized int getIndex() {
        return index;
    }

    public synchronized void setIndex(int value) {
        index = value;
    }
}
