package io.troupe.player;

import io.troupe.player.structures.rfid.PlayerRfidData;

/**
 * A reader of radio tags, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface rfid.
 */
public class RFIDInterface extends UnofferedDevice {
    public RFIDInterface(PlayerClient client) {
        super(client, "rfid");
    }

    public PlayerRfidData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
