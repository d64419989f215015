package io.troupe.player.structures.position2d;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** A velocity command; simulated robots ignore its state, as Stage does. */
public class PlayerPosition2dCmdVel {
    private PlayerPose vel = new PlayerPose();
    private byte state;

    public synchronized PlayerPose getVel() {
        return vel;
    }

    public synchronized void setVel(PlayerPose2d value) {
        vel = PlayerPose.of(value);
    }

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
