package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
public class PlayerAudioMixerChannel {
    private float amplitude;
    private boolean active;
    private int index;

    public synchronized float getAmplitude() {
        return amplitude;
    }

    public synchronized void setAmplitude(float value) {
        amplitude = value;
    }

    public synchronized boolean getActive() {
        return active;
    }

    public synchronized void setActive(boolean value) {
        active = value;
    }

    public synchronized int getIndex() {
        return index;
    }

    public synchronized void setIndex(int value) {
        index = value;
    }
}
