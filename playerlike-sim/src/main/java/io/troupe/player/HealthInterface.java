package io.troupe.player;

import io.troupe.player.structures.health.PlayerHealthData;

/**
 * The load of a machine, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface health.
 */
public class HealthInterface extends UnofferedDevice {
    public HealthInterface(PlayerClient client) {
        super(client, "health");
    }

    public PlayerHealthData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
