package io.troupe.player;

import io.troupe.player.structures.health.PlayerHealthData;

/**
 * The load of the server machine. This client does not support it; the class exists so that programs that mention it
 * compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface health.
 */
public class HealthInterface extends UnsupportedDevice {
    public HealthInterface(PlayerClient client) {
        super(client, "health");
    }

    public PlayerHealthData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
