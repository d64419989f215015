package io.troupe.player;

import io.troupe.player.structures.ir.PlayerIrData;
import io.troupe.player.structures.ir.PlayerIrPose;

/**
 * Infrared sensors, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface ir.
 */
public class IRInterface extends UnofferedDevice {
    public IRInterface(PlayerClient client) {
        super(client, "ir");
    }

    public PlayerIrData getData() {
        throw notOffered();
    }

    public PlayerIrPose getPose() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isPoseReady() {
        throw notOffered();
    }

    public void queryPose() {
        throw notOffered();
    }

    public void setIRPower(int state) {
        throw notOffered();
    }
}
