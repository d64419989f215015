package io.troupe.player.structures.player;

import io.troupe.player.structures.PlayerDevAddr;

/** The list of a server's devices. */
public class PlayerDeviceDevlist {
    private int deviceCount;
    private PlayerDevAddr[] devList = new PlayerDevAddr[0];

    public synchronized int getDeviceCount() {
        return deviceCount;
    }

    public synchronized void setDeviceCount(int value) {
        deviceCount = value;
    }

    public synchronized PlayerDevAddr[] getDevList() {
        return devList;
    }

    public synchronized void setDevList(PlayerDevAddr[] value) {
        devList = value;
    }
}
