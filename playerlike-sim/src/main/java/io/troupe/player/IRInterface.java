package io.troupe.player;

import io.troupe.player.structures.ir.PlayerIrData;
import io.troupe.player.structures.ir.PlayerIrPose;

/**
 * Infrared sensors. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
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
