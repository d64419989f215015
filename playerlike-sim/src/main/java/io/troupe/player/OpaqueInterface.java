package io.troupe.player;

import io.troupe.player.structures.opaque.PlayerOpaqueData;

/**
 * Messages of a driver that has its own, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface opaque.
 */
public class OpaqueInterface extends UnofferedDevice {
    public OpaqueInterface(PlayerClient client) {
        super(client, "opaque");
    }

    public PlayerOpaqueData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public void command(byte[] data) {
        throw notOffered();
    }

    public void request(byte[] data) {
        throw notOffered();
    }
}
