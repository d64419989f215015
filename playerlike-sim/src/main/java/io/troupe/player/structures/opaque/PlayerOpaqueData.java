package io.troupe.player.structures.opaque;

/** Data of the Player interface opaque. This client does not use it. */
public class PlayerOpaqueData {
    private int data_count;
    private byte[] data = new byte[0];

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
