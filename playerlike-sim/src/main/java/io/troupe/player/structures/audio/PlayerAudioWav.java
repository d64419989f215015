package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
public class PlayerAudioWav {
    private int format;
    private int data_count;
    private byte[] data = new byte[0];

    public synchronized int getFormat() {
        return format;
    }

    public synchronized void setFormat(int value) {
        format = value;
    }

    public synchronized int getData_count() {
        return data_count;
    }

    public synchronized void setData_count(int value) {
        data_count = value;
    }

    public synchronized byte[] getData() {
        return data;
    }

    public synchronized void setData(byte[] value) {
        data = value;
    }
}
