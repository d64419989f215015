package io.troupe.player.structures.mcom;

/** Data of the Player interface mcom. This client does not use it. */
public class PlayerMcomData {
    private char full;
    private int data_count;
    private char[] data = new char[0];

    public synchronized char getFull() {
        return full;
    }

    public synchronized void setFull(char value) {
        full = value;
    }

    public synchronized int getData_count() {
        return data_count;
    }

    public synchronized void setData_count(int value) {
        data_count = value;
    }

    public synchronized char[] getData() {
        return data;
    }

    public synchronized void setData(char[] value) {
        data = value;
    }
}
