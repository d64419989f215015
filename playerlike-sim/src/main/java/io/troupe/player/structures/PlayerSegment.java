package io.troupe.player.structures;

/** A line from one point to another, in metres. */
public class PlayerSegment {
    private double x0;
    private double y0;
    private double x1;
    private double y1;

    public synchronized double getX0() {
        return x0;
    }

    public synchronized void setX0(double value) {
        x0 = value;
    }

    public synchronized double getY0() {
        return y0;
    }

    public synchronized void setY0(double value) {
        y0 = value;
    }

    public synchronized double getX1() {
        return x1;
    }

    public synchronized void setX1(double value) {
        x1 = value;
    }

    public synchronized double getY1() {
        return y1;
    }

    public synchronized void setY1(double value) {
        y1 = value;
    }
}
