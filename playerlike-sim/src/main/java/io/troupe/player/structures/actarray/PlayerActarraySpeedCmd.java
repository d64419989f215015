package io.troupe.player.structures.actarray;

/** A command of the Player interface actarray. This client does not use it. */
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
