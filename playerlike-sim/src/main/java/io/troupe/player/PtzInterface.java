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
public class PtzInterface extends UnsupportedDevice {
    public PtzInterface(PlayerClient client) {
        super(client, "ptz");
    }

    public PlayerPtzData getData() {
        throw notSupported();
    }

    public PlayerPtzGeom getGeom() {
        throw notSupported();
    }

    public int getStatus() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isGeomReady() {
        throw notSupported();
    }

    public void setPTZ(PlayerPtzCmd value) {
        throw notSupported();
    }

    public void queryGeometry() {
        throw notSupported();
    }

    public void genericRequest(int configCount, int[] config) {
        throw notSupported();
    }

    public void controlRequest(int mode) {
        throw notSupported();
    }

    public void statusRequest() {
        throw notSupported();
    }
}
