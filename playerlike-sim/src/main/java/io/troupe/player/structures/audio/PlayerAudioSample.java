package io.troupe.player.structures.audio;

/** A part of the messages of sound; no device here uses it. */
public class PlayerAudioSample {
    private PlayerAudioWav sample = new PlayerAudioWav();
    private int index;

    public synchronized PlayerAudioWav getSample() {
        return sample;
    }

    public synchronized void setSample(PlayerAudioWav value) {
        sample = value;
    }

    public synchronized int getIndex() {
        return index;
    }

    public synchronized void setIndex(int value) {
        index = value;
    }
}
