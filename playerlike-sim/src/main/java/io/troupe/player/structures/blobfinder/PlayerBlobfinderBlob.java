package io.troupe.player.structures.blobfinder;

/** A colour blob, in pixels; x grows to the right, y downwards; the range is in metres. */
public class PlayerBlobfinderBlob {
    private int id;
    private int color;
    private int area;
    private int x;
    private int y;
    private int left;
    private int right;
    private int top;
    private int bottom;
    private float range;

    public synchronized int getId() {
        return id;
    }

    public synchronized void setId(int value) {
        id = value;
    }

    public synchronized int getColor() {
        return color;
    }

    public synchronized void setColor(int value) {
        color = value;
    }

    public synchronized int getArea() {
        return area;
    }

    public synchronized void setArea(int value) {
        area = value;
    }

    public synchronized int getX() {
        return x;
    }

    public synchronized void setX(int value) {
        x = value;
    }

    public synchronized int getY() {
        return y;
    }

    public synchronized void setY(int value) {
        y = value;
    }

    public synchronized int getLeft() {
        return left;
    }

    public synchronized void setLeft(int value) {
        left = value;
    }

    public synchronized int getRight() {
        return right;
    }

    public synchronized void setRight(int value) {
        right = value;
    }

    public synchronized int getTop() {
        return top;
    }

    public synchronized void setTop(int value) {
        top = value;
    }

    public synchronized int getBottom() {
        return bottom;
    }

    public synchronized void setBottom(int value) {
        bottom = value;
    }

    public synchronized float getRange() {
        return range;
    }

    public synchronized void setRange(float value) {
        range = value;
    }
}
