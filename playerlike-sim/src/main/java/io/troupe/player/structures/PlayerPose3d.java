package io.troupe.player.structures;

/** A 3D pose: metres and radians. */
public class PlayerPose3d {
    private double px;
    private double py;
    private double pz;
    private double proll;
    private double ppitch;
    private double pyaw;

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

    /** The yaw, under the name of the same field in a 2D pose: older programs read the pose of a laser with it. */
    public synchronized double getPa() {
        return pyaw;
    }

    public synchronized void setPa(double value) {
        pyaw = value;
    }
}
