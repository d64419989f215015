package io.troupe.player;

import io.troupe.player.structures.wsn.PlayerWsnCmd;
import io.troupe.player.structures.wsn.PlayerWsnData;

/**
 * A wireless sensor network. This client does not support it; the class exists so that programs that mention it
 * compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface wsn.
 */
public class WSNInterface extends UnsupportedDevice {
    public WSNInterface(PlayerClient client) {
        super(client, "wsn");
    }

    public PlayerWsnData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public void setDeviceState(PlayerWsnCmd value) {
        throw notSupported();
    }

    public void setPower(int nodeID, int groupID, int value) {
        throw notSupported();
    }

    public void setDataType(int value) {
        throw notSupported();
    }

    public void setDataFreq(int nodeID, int groupID, double frequency) {
        throw notSupported();
    }
}
