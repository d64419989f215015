package io.troupe.player.structures.position2d;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** Data of the position2d interface: pose, velocity and stall. */
public class PlayerPosition2dData {
    private PlayerPose pos = new PlayerPose();
    private PlayerPose vel = new PlayerPose();
    private byte stall;

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

    public synchronized byte getStall() {
        return stall;
    }

    public synchronized void setStall(byte value) {
        stall = value;
    }
}
