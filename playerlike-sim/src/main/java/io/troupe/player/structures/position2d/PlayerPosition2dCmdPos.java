package io.troupe.player.structures.position2d;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** A command to drive to a pose in the odometry frame; simulated robots ignore its state, as Stage does. */
public class PlayerPosition2dCmdPos {
    private PlayerPose pos = new PlayerPose();
    private PlayerPose vel = new PlayerPose();
    private byte state;

    public synchronized PlayerPose getPos() {
        return pos;
    }

    public synchronized void setPos(PlayerPose2d value) {
        pos = PlayerPose.of(value);
    }

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
