package io.troupe.player.structures.limb;

/** A command of the Player interface limb. This client does not use it. */
public class PlayerLimbSetpositionCmd {
    private float px;
    private float py;
    private float pz;

    public synchronized float getPx() {
        return px;
    }

    public synchronized void setPx(float value) {
        px = value;
    }

    public synchronized float getPy() {
        return py;
    }

    public synchronized void setPy(float value) {
        py = value;
    }

    public synchronized float getPz() {
        return pz;
    }

    public synchronized void setPz(float value) {
        pz = value;
    }
}
