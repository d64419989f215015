package io.troupe.player.structures.planner;

/** A request of the Player interface planner. This client does not use it. */
public class PlayerPlannerEnableReq {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
