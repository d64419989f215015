package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
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
