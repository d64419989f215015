package io.troupe.player.structures.audio;

/** A part of the messages of sound; no device here uses it. */
public class PlayerAudioState {
    private int state;

    public synchronized int getState() {
        return state;
    }

    public synchronized void setState(int value) {
        state = value;
    }
}
