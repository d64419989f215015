package io.troupe.player;

import io.troupe.player.structures.ptz.PlayerPtzCmd;
import io.troupe.player.structures.ptz.PlayerPtzData;
import io.troupe.player.structures.ptz.PlayerPtzGeom;

/**
 * A pan-tilt-zoom camera. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
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
