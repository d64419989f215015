package io.troupe.player.structures.actarray;

/** A command of an array of actuators; no device here uses it. */
public class PlayerActarrayHomeCmd {
    private char joint;

    public synchronized char getJoint() {
        return joint;
    }

    public synchronized void setJoint(char value) {
        joint = value;
    }
}
