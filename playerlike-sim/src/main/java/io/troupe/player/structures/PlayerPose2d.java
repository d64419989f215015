package io.troupe.player.structures;

/** A 2D pose: metres and radians. */
public class PlayerPose2d {
    private double px;
    private double py;
    private double pa;

    public PlayerPose2d() {}

    public PlayerPose2d(double x, double y, double a) {
        px = x;
        py = y;
        pa = a;
    }

    @Override
    public synchronized String toString() {
        return "(" + px + ", " + py + ", " + pa + ")";
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

    public synchronized double getPa() {
        return pa;
    }

    public synchronized void setPa(double value) {
        pa = value;
    }
}
