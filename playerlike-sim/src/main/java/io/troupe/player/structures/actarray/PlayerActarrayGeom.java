package io.troupe.player.structures.actarray;

import io.troupe.player.structures.PlayerOrientation3d;
import io.troupe.player.structures.PlayerPoint3d;

/** Part of a message of the Player interface actarray. This client does not use it. */
public class PlayerActarrayGeom {
    private int actuators_count;
    private PlayerActarrayActuatorGeom[] actuators = new PlayerActarrayActuatorGeom[0];
    private PlayerOrientation3d orientation = new PlayerOrientation3d();
    private PlayerPoint3d basePos = new PlayerPoint3d();

    public synchronized int getActuators_count() {
        return actuators_count;
    }

    public synchronized void setActuators_count(int value) {
        actuators_count = value;
    }

    public synchronized PlayerActarrayActuatorGeom[] getActuators() {
        return actuators;
    }

    public synchronized void setActuators(PlayerActarrayActuatorGeom[] value) {
        actuators = value;
    }

    public synchronized PlayerOrientation3d getOrientation() {
        return orientation;
    }

    public synchronized void setOrientation(PlayerOrientation3d value) {
        orientation = value;
    }

    public synchronized PlayerPoint3d getBasePos() {
        return basePos;
    }

    public synchronized void setBasePos(PlayerPoint3d value) {
        basePos = value;
    }
}
