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
public class BlinkenlightInterface extends UnofferedDevice {
    public BlinkenlightInterface(PlayerClient client) {
        super(client, "blinkenlight");
    }

    public PlayerBlinkenlightData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public void setState(PlayerBlinkenlightData value) {
        throw notOffered();
    }

    public void setPower(int state) {
        throw notOffered();
    }

    public void setColor(PlayerColor color) {
        throw notOffered();
    }

    public void setPeriod(int period) {
        throw notOffered();
    }

    public void setDutycycle(int dutycycle) {
        throw notOffered();
    }
}
