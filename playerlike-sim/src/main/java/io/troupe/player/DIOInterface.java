package io.troupe.player;

import io.troupe.player.structures.dio.PlayerDioData;

/**
 * Digital inputs and outputs. This client does not support it; the class exists so that programs that mention it
 * compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface dio.
 */
public class DIOInterface extends UnsupportedDevice {
    public DIOInterface(PlayerClient client) {
        super(client, "dio");
    }

    public PlayerDioData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public void setOutputBitfield(int count, int bits) {
        throw notSupported();
    }
}
