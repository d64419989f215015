package io.troupe.player.structures.limb;

/** A command of the Player interface limb. This client does not use it. */
public class PlayerLimbSetposeCmd {
    private float px;
    private float py;
    private float pz;
    private float ax;
    private float ay;
    private float az;
    private float ox;
    private float oy;
    private float oz;

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

    public synchronized float getAx() {
        return ax;
    }

    public synchronized void setAx(float value) {
        ax = value;
    }

    public synchronized float getAy() {
        return ay;
    }

    public synchronized void setAy(float value) {
        ay = value;
    }

    public synchronized float getAz() {
        return az;
    }

    public synchronized void setAz(float value) {
        az = value;
    }

    public synchronized float getOx() {
        return ox;
    }

    public synchronized void setOx(float value) {
        ox = value;
    }

    public synchronized float getOy() {
        return oy;
    }

    public synchronized void setOy(float value) {
        oy = value;
    }

    public synchronized float getOz() {
        return oz;
    }

    public synchronized void setOz(float value) {
        oz = value;
    }
}
