package io.troupe.player.structures.position3d;

import io.troupe.player.structures.PlayerPose3d;

/** A setting or a question of a robot that moves in space; no device here uses it. */
public class PlayerPosition3dSetOdomReq {
    private PlayerPose3d pos = new PlayerPose3d();

    public synchronized PlayerPose3d getPos() {
        return pos;
    }

    public synchronized void setPos(PlayerPose3d value) {
        pos = value;
    }
}
