package io.troupe.player;

import io.troupe.player.structures.power.PlayerPowerData;

/**
 * A battery, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface power.
 */
public class PowerInterface extends UnofferedDevice {
    public PowerInterface(PlayerClient client) {
        super(client, "power");
    }

    public PlayerPowerData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public void requestCharge(int enable_input, int enable_output) {
        throw notOffered();
    }
}
