package io.troupe.player;

import io.troupe.player.structures.PlayerColor;
import io.troupe.player.structures.blinkenlight.PlayerBlinkenlightData;

/**
 * A light. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface blinkenlight.
 */
public class BlinkenlightInterface extends UnsupportedDevice {
    public BlinkenlightInterface(PlayerClient client) {
        super(client, "blinkenlight");
    }

    public PlayerBlinkenlightData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public void setState(PlayerBlinkenlightData value) {
        throw notSupported();
    }

    public void setPower(int state) {
        throw notSupported();
    }

    public void setColor(PlayerColor color) {
        throw notSupported();
    }

    public void setPeriod(int period) {
        throw notSupported();
    }

    public void setDutycycle(int dutycycle) {
        throw notSupported();
    }
}
