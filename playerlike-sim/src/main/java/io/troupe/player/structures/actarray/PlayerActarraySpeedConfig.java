package io.troupe.player.structures.actarray;

/** A request of the Player interface actarray. This client does not use it. */
public class PlayerActarraySpeedConfig {
    private char joint;
    private float speed;

    public synchronized char getJoint() {
        return joint;
    }

    public synchronized void setJoint(char value) {
        joint = value;
    }

    public synchronized float getSpeed() {
        return speed;
    }

    public synchronized void setSpeed(float value) {
        speed = value;
    }
}
