package io.troupe.player;

import io.troupe.player.structures.opaque.PlayerOpaqueData;

/**
 * Driver-defined messages. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface opaque.
 */
public class OpaqueInterface extends UnsupportedDevice {
    public OpaqueInterface(PlayerClient client) {
        super(client, "opaque");
    }

    public PlayerOpaqueData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public void command(byte[] data) {
        throw notSupported();
    }

    public void request(byte[] data) {
        throw notSupported();
    }
}
