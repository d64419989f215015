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
public class FiducialInterface extends UnsupportedDevice {
    public FiducialInterface(PlayerClient client) {
        super(client, "fiducial");
    }

    public void queryGeometry() {
        throw notSupported();
    }

    public void queryFOV() {
        throw notSupported();
    }

    public void setFov(PlayerFiducialFov value) {
        throw notSupported();
    }

    public void queryFiducialVal() {
        throw notSupported();
    }

    public void setFiducialVal(int id) {
        throw notSupported();
    }

    public PlayerFiducialData getData() {
        throw notSupported();
    }

    public PlayerFiducialGeom getGeom() {
        throw notSupported();
    }

    public PlayerFiducialFov getFOV() {
        throw notSupported();
    }

    public int getID() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isGeomReady() {
        throw notSupported();
    }

    public boolean isFOVReady() {
        throw notSupported();
    }

    public boolean isIDReady() {
        throw notSupported();
    }
}
