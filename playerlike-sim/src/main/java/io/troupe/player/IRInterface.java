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
public class IRInterface extends UnsupportedDevice {
    public IRInterface(PlayerClient client) {
        super(client, "ir");
    }

    public PlayerIrData getData() {
        throw notSupported();
    }

    public PlayerIrPose getPose() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isPoseReady() {
        throw notSupported();
    }

    public void queryPose() {
        throw notSupported();
    }

    public void setIRPower(int state) {
        throw notSupported();
    }
}
