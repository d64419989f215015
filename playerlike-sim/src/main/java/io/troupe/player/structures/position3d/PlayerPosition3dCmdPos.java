package io.troupe.player.structures.position3d;

import io.troupe.player.structures.PlayerPose3d;

/** A command of the Player interface position3d. This client does not use it. */
public class PlayerPosition3dCmdPos {
    private PlayerPose3d pos = new PlayerPose3d();
    private PlayerPose3d vel = new PlayerPose3d();
    private byte state;

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

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
