package io.troupe.player;

import io.troupe.player.structures.fiducial.PlayerFiducialData;
import io.troupe.player.structures.fiducial.PlayerFiducialFov;
import io.troupe.player.structures.fiducial.PlayerFiducialGeom;

/**
 * A finder of marks, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
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
