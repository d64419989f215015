package io.troupe.player;

import io.troupe.player.structures.ptz.PlayerPtzCmd;
import io.troupe.player.structures.ptz.PlayerPtzData;
import io.troupe.player.structures.ptz.PlayerPtzGeom;

/**
 * A camera that pans, tilts and zooms, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface ptz.
 */
public class PtzInterface extends UnofferedDevice {
    public PtzInterface(PlayerClient client) {
        super(client, "ptz");
    }

    public PlayerPtzData getData() {
        throw notOffered();
    }

    public PlayerPtzGeom getGeom() {
        throw notOffered();
    }

    public int getStatus() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isGeomReady() {
        throw notOffered();
    }

    public void setPTZ(PlayerPtzCmd value) {
        throw notOffered();
    }

    public void queryGeometry() {
        throw notOffered();
    }

    public void genericRequest(int configCount, int[] config) {
        throw notOffered();
    }

    public void controlRequest(int mode) {
        throw notOffered();
    }

    public void statusRequest() {
        throw notOffered();
    }
}
