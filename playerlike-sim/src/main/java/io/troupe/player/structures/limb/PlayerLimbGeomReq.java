package io.troupe.player.structures.limb;

import io.troupe.player.structures.PlayerPoint3d;

/** A request of the Player interface limb. This client does not use it. */
public class PlayerLimbGeomReq {
    private PlayerPoint3d basePos = new PlayerPoint3d();

    public synchronized PlayerPoint3d getBasePos() {
        return basePos;
    }

    public synchronized void setBasePos(PlayerPoint3d value) {
        basePos = value;
    }

    public synchronized PlayerPoint3d getX() {
        return basePos;
    }
}
