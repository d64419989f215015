package io.troupe.player.structures.audiomixer;

/** A command of the Player interface audiomixer. This client does not use it. */
public class PlayerAudiomixerCmd {
    private int left;
    private int right;

    public synchronized int getLeft() {
        return left;
    }

    public synchronized void setLeft(int value) {
        left = value;
    }

    public synchronized int getRight() {
        return right;
    }

    public synchronized void setRight(int value) {
        right = value;
    }
}
