package io.troupe.player.structures.position2d;

/** A setting or a question of the position2d interface, by its name in the original client. */
public class PlayerPosition2dPositionModeReq {
    private int state;

    public synchronized int getState() {
        return state;
    }

    public synchronized void setState(int value) {
        state = value;
    }
}
