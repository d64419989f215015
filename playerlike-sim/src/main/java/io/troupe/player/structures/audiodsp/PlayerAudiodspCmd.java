package io.troupe.player.structures.audiodsp;

/** A command of the Player interface audiodsp. This client does not use it. */
public class PlayerAudiodspCmd {
    private float frequency;
    private float amplitude;
    private float duration;
    private int bit_string_count;
    private byte[] bit_string = new byte[0];
    private int bit_string_len;

    public synchronized float getFrequency() {
        return frequency;
    }

    public synchronized void setFrequency(float value) {
        frequency = value;
    }

    public synchronized float getAmplitude() {
        return amplitude;
    }

    public synchronized void setAmplitude(float value) {
        amplitude = value;
    }

    public synchronized float getDuration() {
        return duration;
    }

    public synchronized void setDuration(float value) {
        duration = value;
    }

    public synchronized int getBit_string_count() {
        return bit_string_count;
    }

    public synchronized void setBit_string_count(int value) {
        bit_string_count = value;
    }

    public synchronized byte[] getBit_string() {
        return bit_string;
    }

    public synchronized void setBit_string(byte[] value) {
        bit_string = value;
    }

    public synchronized int getBit_string_len() {
        return bit_string_len;
    }

    public synchronized void setBit_string_len(int value) {
        bit_string_len = value;
    }
}
