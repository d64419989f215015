package io.troupe.player;

import io.troupe.player.structures.wsn.PlayerWsnCmd;
import io.troupe.player.structures.wsn.PlayerWsnData;

/**
 * A network of sensor nodes, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface wsn.
 */
public class WSNInterface extends UnofferedDevice {
    public WSNInterface(PlayerClient client) {
        super(client, "wsn");
    }

    public PlayerWsnData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public void setDeviceState(PlayerWsnCmd value) {
        throw notOffered();
    }

    public void setPower(int nodeID, int groupID, int value) {
        throw notOffered();
    }

    public void setDataType(int value) {
        throw notOffered();
    }

    public void setDataFreq(int nodeID, int groupID, double frequency) {
        throw notOffered();
    }
}
