package io.troupe.player;

import io.troupe.player.structures.PlayerColor;
import io.troupe.player.structures.blinkenlight.PlayerBlinkenlightData;

/**
 * A lamp, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
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
