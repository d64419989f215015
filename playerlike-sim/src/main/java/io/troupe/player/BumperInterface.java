package io.troupe.player;

import io.troupe.player.structures.bumper.PlayerBumperData;
import io.troupe.player.structures.bumper.PlayerBumperGeom;

/**
 * Bumpers, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
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
