package io.troupe.player.structures.actarray;

/** A command of an array of actuators; no device here uses it. */
public class PlayerActarrayPositionCmd {
    private byte joint;
    private float position;

    public synchronized byte getJoint() {
        return joint;
    }

    public synchronized void setJoint(byte value) {
        joint = value;
    }

    public synchronized float getPosition() {
        return position;
    }

    public synchronized void setPosition(float value) {
        position = value;
    }
}
