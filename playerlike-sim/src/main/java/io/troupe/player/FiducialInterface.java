package io.troupe.player;

import io.troupe.player.structures.fiducial.PlayerFiducialData;
import io.troupe.player.structures.fiducial.PlayerFiducialFov;
import io.troupe.player.structures.fiducial.PlayerFiducialGeom;

/**
 * A fiducial marker detector. This client does not support it; the class exists so that programs that mention it
 * compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface fiducial.
 */
public class FiducialInterface extends UnofferedDevice {
    public FiducialInterface(PlayerClient client) {
        super(client, "fiducial");
    }

    public void queryGeometry() {
        throw notOffered();
    }

    public void queryFOV() {
        throw notOffered();
    }

    public void setFov(PlayerFiducialFov value) {
        throw notOffered();
    }

    public void queryFiducialVal() {
        throw notOffered();
    }

    public void setFiducialVal(int id) {
        throw notOffered();
    }

    public PlayerFiducialData getData() {
        throw notOffered();
    }

    public PlayerFiducialGeom getGeom() {
        throw notOffered();
    }

    public PlayerFiducialFov getFOV() {
        throw notOffered();
    }

    public int getID() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isGeomReady() {
        throw notOffered();
    }

    public boolean isFOVReady() {
        throw notOffered();
    }

    public boolean isIDReady() {
        throw notOffered();
    }
}
