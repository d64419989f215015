package io.troupe.player.structures.wsn;

/** A command of the Player interface wsn. This client does not use it. */
public class PlayerWsnCmd {
    private int node_id;
    private int group_id;
    private int device;
    private byte state;

    public synchronized int getNode_id() {
        return node_id;
    }

    public synchronized void setNode_id(int value) {
        node_id = value;
    }

    public synchronized int getGroup_id() {
        return group_id;
    }

    public synchronized void setGroup_id(int value) {
        group_id = value;
    }

    public synchronized int getDevice() {
        return device;
    }

    public synchronized void setDevice(int value) {
        device = value;
    }

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
