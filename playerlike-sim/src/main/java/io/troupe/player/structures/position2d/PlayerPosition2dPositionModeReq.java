package io.troupe.player.structures.position2d;

/** A request of the Player interface position2d, named as in the original client. */
public class PlayerPosition2dPositionModeReq {
    private int state;

    public synchronized int getState() {
        return state;
    }

    public synchronized void setState(int value) {
        state = value;
    }
}
