package io.troupe.player;

import io.troupe.player.structures.aio.PlayerAioData;

/**
 * Analogue inputs and outputs. This client does not support it; the class exists so that programs that mention it
 * compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface aio.
 */
public class AIOInterface extends UnsupportedDevice {
    public AIOInterface(PlayerClient client) {
        super(client, "aio");
    }

    public PlayerAioData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public void setState(int id, float voltage) {
        throw notSupported();
    }
}
