package io.troupe.player.structures.actarray;

/** A setting or a question of an array of actuators; no device here uses it. */
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
