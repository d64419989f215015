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
public class BumperInterface extends UnofferedDevice {
    public BumperInterface(PlayerClient client) {
        super(client, "bumper");
    }

    public PlayerBumperData getData() {
        throw notOffered();
    }

    public PlayerBumperGeom getGeom() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isGeomReady() {
        throw notOffered();
    }

    public void queryGeometry() {
        throw notOffered();
    }
}
