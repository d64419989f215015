package io.troupe.player.structures.position2d;

import io.troupe.player.structures.PlayerPose2d;

/** A velocity command; state 0 stops the motors. */
public class PlayerPosition2dCmdVel {
    private PlayerPose2d vel = new PlayerPose2d();
    private byte state;

    public synchronized PlayerPose2d getVel() {
        return vel;
    }

    public synchronized void setVel(PlayerPose2d value) {
        vel = value;
    }

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
