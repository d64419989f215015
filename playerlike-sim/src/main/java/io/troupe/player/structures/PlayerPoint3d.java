package io.troupe.player.structures;

/** A 3D point, in metres. */
public class PlayerPoint3d {
    private double px;
    private double py;
    private double pz;

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

    public synchronized double getPz() {
        return pz;
    }

    public synchronized void setPz(double value) {
        pz = value;
    }
}
