package io.troupe.player.structures.actarray;

/** A command of the Player interface actarray. This client does not use it. */
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
