package io.troupe.player.structures.waveform;

/** Data of the Player interface waveform. This client does not use it. */
public class PlayerWaveformData {
    private int rate;
    private int depth;
    private int data_count;
    private byte[] data = new byte[0];

    public synchronized int getRate() {
        return rate;
    }

    public synchronized void setRate(int value) {
        rate = value;
    }

    public synchronized int getDepth() {
        return depth;
    }

    public synchronized void setDepth(int value) {
        depth = value;
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
