package io.troupe.player.structures.gripper;

/** Data of the Player interface gripper. */
public class PlayerGripperData {
    private int state;
    private int beams;
    private int stored;

    public synchronized int getState() {
        return state;
    }

    public synchronized void setState(int value) {
        state = value;
    }

    public synchronized int getBeams() {
        return beams;
    }

    public synchronized void setBeams(int value) {
        beams = value;
    }

    public synchronized int getStored() {
        return stored;
    }

    public synchronized void setStored(int value) {
        stored = value;
    }
}
