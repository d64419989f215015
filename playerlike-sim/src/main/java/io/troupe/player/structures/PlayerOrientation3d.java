package io.troupe.player.structures;

/** A 3D orientation, in radians. */
public class PlayerOrientation3d {
    private double proll;
    private double ppitch;
    private double pyaw;

    public synchronized double getProll() {
        return proll;
    }

    public synchronized void setProll(double value) {
        proll = value;
    }

    public synchronized double getPpitch() {
        return ppitch;
    }

    public synchronized void setPpitch(double value) {
        ppitch = value;
    }

    public synchronized double getPyaw() {
        return pyaw;
    }

    public synchronized void setPyaw(double value) {
        pyaw = value;
    }
}
