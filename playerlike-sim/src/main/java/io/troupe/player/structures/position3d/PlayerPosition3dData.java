package io.troupe.player.structures.position3d;

import io.troupe.player.structures.PlayerPose3d;

/** Data of the Player interface position3d. This client does not use it. */
public class PlayerPosition3dData {
    private PlayerPose3d pos = new PlayerPose3d();
    private PlayerPose3d vel = new PlayerPose3d();
    private byte stall;

    public synchronized PlayerPose3d getPos() {
        return pos;
    }

    public synchronized void setPos(PlayerPose3d value) {
        pos = value;
    }

    public synchronized PlayerPose3d getVel() {
        return vel;
    }

    public synchronized void setVel(PlayerPose3d value) {
        vel = value;
    }

    public synchronized byte getStall() {
        return stall;
    }

    public synchronized void setStall(byte value) {
        stall = value;
    }
}
