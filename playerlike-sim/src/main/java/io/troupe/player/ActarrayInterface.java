package io.troupe.player;

import io.troupe.player.structures.actarray.PlayerActarrayData;
import io.troupe.player.structures.actarray.PlayerActarrayGeom;

/**
 * An array of actuators. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface actarray.
 */
public class ActarrayInterface extends UnofferedDevice {
    public ActarrayInterface(PlayerClient client) {
        super(client, "actarray");
    }

    public void setPosition(int joint, float position) {
        throw notOffered();
    }

    public void setSpeed(int joint, float speed) {
        throw notOffered();
    }

    public void homeCmd(int joint) {
        throw notOffered();
    }

    public void queryGeometry() {
        throw notOffered();
    }

    public void setPower(int state) {
        throw notOffered();
    }

    public void setBrakes(int state) {
        throw notOffered();
    }

    public void setSpeedConfig(int joint, float speed) {
        throw notOffered();
    }

    public PlayerActarrayData getData() {
        throw notOffered();
    }

    public PlayerActarrayGeom getGeom() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isGeomReady() {
        throw notOffered();
    }
}
