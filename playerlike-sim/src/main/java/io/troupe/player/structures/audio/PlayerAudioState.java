package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
public class PlayerAudioState {
    private int state;

    public synchronized int getState() {
        return state;
    }

    public synchronized void setState(int value) {
        state = value;
    }
}
