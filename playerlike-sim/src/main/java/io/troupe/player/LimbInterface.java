package io.troupe.player;

import io.troupe.player.structures.PlayerPoint3d;
import io.troupe.player.structures.limb.PlayerLimbData;
import io.troupe.player.structures.limb.PlayerLimbGeomReq;

/**
 * An arm, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
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
