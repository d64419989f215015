package io.troupe.player.structures.audiodsp;

/** Data of the Player interface audiodsp. This client does not use it. */
public class PlayerAudiodspData {
    private int frequency_count;
    private float[] frequency = new float[0];
    private int amplitude_count;
    private float[] amplitude = new float[0];

    public synchronized int getFrequency_count() {
        return frequency_count;
    }

    public synchronized void setFrequency_count(int value) {
        frequency_count = value;
    }

    public synchronized float[] getFrequency() {
        return frequency;
    }

    public synchronized void setFrequency(float[] value) {
        frequency = value;
    }

    public synchronized int getAmplitude_count() {
        return amplitude_count;
    }

    public synchronized void setAmplitude_count(int value) {
        amplitude_count = value;
    }

    public synchronized float[] getAmplitude() {
        return amplitude;
    }

    public synchronized void setAmplitude(float[] value) {
        amplitude = value;
    }
}
