package io.troupe.player.structures.map;

/** Data of the Player interface map. This client does not use it. */
public class PlayerMapData {
    private int col;
    private int row;
    private int width;
    private int height;
    private int data_count;
    private byte[] data = new byte[0];
    private byte dataRange;

    public synchronized int getCol() {
        return col;
    }

    public synchronized void setCol(int value) {
        col = value;
    }

    public synchronized int getRow() {
        return row;
    }

    public synchronized void setRow(int value) {
        row = value;
    }

    public synchronized int getWidth() {
        return width;
    }

    public synchronized void setWidth(int value) {
        width = value;
    }

    public synchronized int getHeight() {
        return height;
    }

    public synchronized void setHeight(int value) {
        height = value;
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

    public synchronized byte getDataRange() {
        return dataRange;
    }

    public synchronized void setDataRange(byte value) {
        dataRange = value;
    }
}
