package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
public class PlayerAudioSeqItem {
    private float frequency;
    private float duration;
    private float amplitude;
    private boolean link;

    public synchronized float getFrequency() {
        return frequency;
    }

    public synchronized void setFrequency(float value) {
        frequency = value;
    }

    public synchronized float getDuration() {
        return duration;
    }

    public synchronized void setDuration(float value) {
        duration = value;
    }

    public synchronized float getAmplitude() {
        return amplitude;
    }

    public synchronized void setAmplitude(float value) {
        amplitude = value;
    }

    public synchronized boolean getLink() {
        return link;
    }

    public synchronized void setLink(boolean value) {
        link = value;
    }
}
