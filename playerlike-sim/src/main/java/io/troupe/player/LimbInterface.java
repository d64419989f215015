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
public class LimbInterface extends UnofferedDevice {
    public LimbInterface(PlayerClient client) {
        super(client, "limb");
    }

    public void homeCmd() {
        throw notOffered();
    }

    public void stopCmd() {
        throw notOffered();
    }

    public void setPose(PlayerPoint3d position, PlayerPoint3d approach, PlayerPoint3d orientation) {
        throw notOffered();
    }

    public void setPosition(PlayerPoint3d position) {
        throw notOffered();
    }

    public void vectorMove(PlayerPoint3d direction, float length) {
        throw notOffered();
    }

    public void setPower(int value) {
        throw notOffered();
    }

    public void setBrakes(int value) {
        throw notOffered();
    }

    public void queryGeometry() {
        throw notOffered();
    }

    public void setSpeed(float speed) {
        throw notOffered();
    }

    public PlayerLimbData getData() {
        throw notOffered();
    }

    public PlayerLimbGeomReq getGeom() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isGeomReady() {
        throw notOffered();
    }
}
