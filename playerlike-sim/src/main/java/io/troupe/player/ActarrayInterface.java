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
public class ActarrayInterface extends UnsupportedDevice {
    public ActarrayInterface(PlayerClient client) {
        super(client, "actarray");
    }

    public void setPosition(int joint, float position) {
        throw notSupported();
    }

    public void setSpeed(int joint, float speed) {
        throw notSupported();
    }

    public void homeCmd(int joint) {
        throw notSupported();
    }

    public void queryGeometry() {
        throw notSupported();
    }

    public void setPower(int state) {
        throw notSupported();
    }

    public void setBrakes(int state) {
        throw notSupported();
    }

    public void setSpeedConfig(int joint, float speed) {
        throw notSupported();
    }

    public PlayerActarrayData getData() {
        throw notSupported();
    }

    public PlayerActarrayGeom getGeom() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isGeomReady() {
        throw notSupported();
    }
}
