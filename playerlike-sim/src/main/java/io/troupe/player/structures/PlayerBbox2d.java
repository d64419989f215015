package io.troupe.player.structures;

/** A rectangle: width (y extent) and length (x extent), in metres. */
public class PlayerBbox2d {
    private double sw;
    private double sl;

    public synchronized double getSw() {
        return sw;
    }

    public synchronized void setSw(double value) {
        sw = value;
    }

    public synchronized double getSl() {
        return sl;
    }

    public synchronized void setSl(double value) {
        sl = value;
    }
}
