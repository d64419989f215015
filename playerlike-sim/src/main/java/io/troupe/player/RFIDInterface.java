package io.troupe.player;

import io.troupe.player.structures.rfid.PlayerRfidData;

/**
 * An RFID reader. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface rfid.
 */
public class RFIDInterface extends UnsupportedDevice {
    public RFIDInterface(PlayerClient client) {
        super(client, "rfid");
    }

    public PlayerRfidData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
