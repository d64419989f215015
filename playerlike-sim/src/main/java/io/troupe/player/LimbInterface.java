package io.troupe.player;

import io.troupe.player.structures.PlayerPoint3d;
import io.troupe.player.structures.limb.PlayerLimbData;
import io.troupe.player.structures.limb.PlayerLimbGeomReq;

/**
 * A robot arm. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface limb.
 */
public class LimbInterface extends UnsupportedDevice {
    public LimbInterface(PlayerClient client) {
        super(client, "limb");
    }

    public void homeCmd() {
        throw notSupported();
    }

    public void stopCmd() {
        throw notSupported();
    }

    public void setPose(PlayerPoint3d position, PlayerPoint3d approach, PlayerPoint3d orientation) {
        throw notSupported();
    }

    public void setPosition(PlayerPoint3d position) {
        throw notSupported();
    }

    public void vectorMove(PlayerPoint3d direction, float length) {
        throw notSupported();
    }

    public void setPower(int value) {
        throw notSupported();
    }

    public void setBrakes(int value) {
        throw notSupported();
    }

    public void queryGeometry() {
        throw notSupported();
    }

    public void setSpeed(float speed) {
        throw notSupported();
    }

    public PlayerLimbData getData() {
        throw notSupported();
    }

    public PlayerLimbGeomReq getGeom() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isGeomReady() {
        throw notSupported();
    }
}
