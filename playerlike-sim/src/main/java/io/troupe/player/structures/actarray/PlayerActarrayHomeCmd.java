package io.troupe.player.structures.actarray;

/** A command of the Player interface actarray. This client does not use it. */
public class PlayerActarrayHomeCmd {
    private char joint;

    public synchronized char getJoint() {
        return joint;
    }

    public synchronized void setJoint(char value) {
        joint = value;
    }
}
