package io.troupe.player;

import io.troupe.player.structures.gps.PlayerGpsData;

/**
 * A GPS receiver. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface gps.
 */
public class GPSInterface extends UnsupportedDevice {
    public GPSInterface(PlayerClient client) {
        super(client, "gps");
    }

    public PlayerGpsData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
