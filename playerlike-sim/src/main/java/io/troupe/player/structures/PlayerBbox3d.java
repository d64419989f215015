package io.troupe.player.structures;

/** A box: width (y extent), length (x extent) and height, in metres. */
public class PlayerBbox3d extends PlayerBbox2d {
    private double sh;

    public synchronized double getSh() {
        return sh;
    }

    public synchronized void setSh(double value) {
        sh = value;
    }
}
