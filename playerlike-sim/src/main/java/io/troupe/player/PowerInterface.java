package io.troupe.player;

import io.troupe.player.structures.power.PlayerPowerData;

/**
 * A battery. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface power.
 */
public class PowerInterface extends UnsupportedDevice {
    public PowerInterface(PlayerClient client) {
        super(client, "power");
    }

    public PlayerPowerData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public void requestCharge(int enable_input, int enable_output) {
        throw notSupported();
    }
}
