package io.troupe.player.structures.wifi;

/** A request of the Player interface wifi. This client does not use it. */
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
