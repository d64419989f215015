package io.troupe.player.structures.actarray;

import io.troupe.player.structures.PlayerOrientation3d;
import io.troupe.player.structures.PlayerPoint3d;

/** Part of a message of the Player interface actarray. This client does not use it. */
public class PlayerActarrayActuatorGeom {
    private byte type;
    private float length;
    private PlayerOrientation3d orientation = new PlayerOrientation3d();
    private PlayerPoint3d axis = new PlayerPoint3d();
    private float min;
    private float centre;
    private float max;
    private float home;
    private float config_speed;
    private byte hasbrakes;

    public synchronized byte getType() {
        return type;
    }

    public synchronized void setType(byte value) {
        type = value;
    }

    public synchronized float getLength() {
        return length;
    }

    public synchronized void setLength(float value) {
        length = value;
    }

    public synchronized PlayerOrientation3d getOrientation() {
        return orientation;
    }

    public synchronized void setOrientation(PlayerOrientation3d value) {
        orientation = value;
    }

    public synchronized PlayerPoint3d getAxis() {
        return axis;
    }

    public synchronized void setAxis(PlayerPoint3d value) {
        axis = value;
    }

    public synchronized float getMin() {
        return min;
    }

    public synchronized void setMin(float value) {
        min = value;
    }

    public synchronized float getCentre() {
        return centre;
    }

    public synchronized void setCentre(float value) {
        centre = value;
    }

    public synchronized float getMax() {
        return max;
    }

    public synchronized void setMax(float value) {
        max = value;
    }

    public synchronized float getHome() {
        return home;
    }

    public synchronized void setHome(float value) {
        home = value;
    }

    public synchronized float getConfig_speed() {
        return config_speed;
    }

    public synchronized void setConfig_speed(float value) {
        config_speed = value;
    }

    public synchronized byte getHasbrakes() {
        return hasbrakes;
    }

    public synchronized void setHasbrakes(byte value) {
        hasbrakes = value;
    }
}
