package io.troupe.player.structures.actarray;

/** A command of an array of actuators; no device here uses it. */
public class PlayerActarraySpeedCmd {
    private byte joint;
    private float speed;

    public synchronized byte getJoint() {
        return joint;
    }

    public synchronized void setJoint(byte value) {
        joint = value;
    }

    public synchronized float getSpeed() {
        return speed;
    }

    public synchronized void setSpeed(float value) {
        speed = value;
    }
}
