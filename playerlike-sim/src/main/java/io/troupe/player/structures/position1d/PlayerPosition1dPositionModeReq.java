package io.troupe.player.structures.position1d;

/** A setting or a question of a linear actuator; no device here uses it. */
public class PlayerPosition1dPositionModeReq {
    private int state;

    public synchronized int getState() {
        return state;
    }

    public synchronized void setState(int value) {
        state = value;
    }
}
