package io.troupe.player.structures.limb;

import io.troupe.player.structures.PlayerPoint3d;

/** Data of the Player interface limb. This client does not use it. */
public class PlayerLimbData {
    private PlayerPoint3d position = new PlayerPoint3d();
    private PlayerPoint3d approach = new PlayerPoint3d();
    private PlayerPoint3d orientation = new PlayerPoint3d();
    private byte state;

    public synchronized PlayerPoint3d getPosition() {
        return position;
    }

    public synchronized void setPosition(PlayerPoint3d value) {
        position = value;
    }

    public synchronized PlayerPoint3d getApproach() {
        return approach;
    }

    public synchronized void setApproach(PlayerPoint3d value) {
        approach = value;
    }

    public synchronized PlayerPoint3d getOrientation() {
        return orientation;
    }

    public synchronized void setOrientation(PlayerPoint3d value) {
        orientation = value;
    }

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
