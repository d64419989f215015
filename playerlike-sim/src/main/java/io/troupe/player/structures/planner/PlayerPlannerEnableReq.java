package io.troupe.player.structures.planner;

/** A setting or a question of a path planner; no device here uses it. */
public class PlayerPlannerEnableReq {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
