package io.troupe.player;

import io.troupe.player.structures.bumper.PlayerBumperData;
import io.troupe.player.structures.bumper.PlayerBumperGeom;

/**
 * Bumpers. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface bumper.
 */
public class BumperInterface extends UnsupportedDevice {
    public BumperInterface(PlayerClient client) {
        super(client, "bumper");
    }

    public PlayerBumperData getData() {
        throw notSupported();
    }

    public PlayerBumperGeom getGeom() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isGeomReady() {
        throw notSupported();
    }

    public void queryGeometry() {
        throw notSupported();
    }
}
