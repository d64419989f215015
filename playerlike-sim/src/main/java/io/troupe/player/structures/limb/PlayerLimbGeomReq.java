package io.troupe.player.structures.limb;

import io.troupe.player.structures.PlayerPoint3d;

/** A setting or a question of an arm; no device here uses it. */
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
