package io.troupe.player.structures.position3d;

import io.troupe.player.structures.PlayerPose3d;

/** A request of the Player interface position3d. This client does not use it. */
public class PlayerPosition3dSetOdomReq {
    private PlayerPose3d pos = new PlayerPose3d();

    public synchronized PlayerPose3d getPos() {
        return pos;
    }

    public synchronized void setPos(PlayerPose3d value) {
        pos = value;
    }
}
