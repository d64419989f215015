package io.troupe.player;

import io.troupe.player.structures.dio.PlayerDioData;

/**
 * Digital inputs and outputs, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface dio.
 */
public class DIOInterface extends UnofferedDevice {
    public DIOInterface(PlayerClient client) {
        super(client, "dio");
    }

    public PlayerDioData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public void setOutputBitfield(int count, int bits) {
        throw notOffered();
    }
}
