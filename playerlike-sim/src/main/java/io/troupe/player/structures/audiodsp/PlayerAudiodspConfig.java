package io.troupe.player.structures.audiodsp;

/** A request of the Player interface audiodsp. This client does not use it. */
public class PlayerAudiodspConfig {
    private int format;
    private float frequency;
    private int channels;

    public synchronized int getFormat() {
        return format;
    }

    public synchronized void setFormat(int value) {
        format = value;
    }

    public synchronized float getFrequency() {
        return frequency;
    }

    public synchronized void setFrequency(float value) {
        frequency = value;
    }

    public synchronized int getChannels() {
        return channels;
    }

    public synchronized void setChannels(int value) {
        channels = value;
    }
}
