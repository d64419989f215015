package io.troupe.player.structures;

/** A 2D point, in metres. */
public class PlayerPoint2d {
    private double px;
    private double py;

    public PlayerPoint2d() {}

    public PlayerPoint2d(double x, double y) {
        px = x;
        py = y;
    }

    public synchronized double getPx() {
        return px;
    }

    public synchronized void setPx(double value) {
        px = value;
    }

    public synchronized double getPy() {
        return py;
    }

    public synchronized void setPy(double value) {
        py = value;
    }
}
