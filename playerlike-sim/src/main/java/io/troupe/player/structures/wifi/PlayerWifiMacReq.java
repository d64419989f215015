package io.troupe.player.structures.wifi;

/** A setting or a question of a wireless network; no device here uses it. */
public class PlayerWifiMacReq {
    private int mac_count;
    private byte[] mac = new byte[0];

    public synchronized int getMac_count() {
        return mac_count;
    }

    public synchronized void setMac_count(int value) {
        mac_count = value;
    }

    public synchronized byte[] getMac() {
        return mac;
    }

    public synchronized void setMac(byte[] value) {
        mac = value;
    }
}
