package io.troupe.player.structures.player;

import io.troupe.player.structures.PlayerDevAddr;

/** The driver that serves a device. */
public class PlayerDeviceDriverInfo {
    private PlayerDevAddr addr = new PlayerDevAddr();
    private String driverName = "";

    public synchronized PlayerDevAddr getAddr() {
        return addr;
    }

    public synchronized void setAddr(PlayerDevAddr value) {
        addr = value;
    }

    public synchronized String getDriverName() {
        return driverName;
    }

    public synchronized void setDriverName(String value) {
        driverName = value;
    }
}
