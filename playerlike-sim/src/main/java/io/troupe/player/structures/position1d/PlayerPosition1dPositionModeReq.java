package io.troupe.player.structures.position1d;

/** A request of the Player interface position1d. This client does not use it. */
public class PlayerPosition1dPositionModeReq {
    private int state;

    public synchronized int getState() {
        return state;
    }

    public synchronized void setState(int value) {
        state = value;
    }
}
