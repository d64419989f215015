package io.troupe.player;

import io.troupe.player.structures.gps.PlayerGpsData;

/**
 * A satellite receiver, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface gps.
 */
public class GPSInterface extends UnofferedDevice {
    public GPSInterface(PlayerClient client) {
        super(client, "gps");
    }

    public PlayerGpsData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
