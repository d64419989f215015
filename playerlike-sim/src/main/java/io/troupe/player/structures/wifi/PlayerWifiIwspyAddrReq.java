package io.troupe.player.structures.wifi;

/** A setting or a question of a wireless network; no device here uses it. */
public class PlayerWifiIwspyAddrReq {
    private char[] address = new char[0];

    public synchronized char[] getAddress() {
        return address;
    }

    public synchronized void setAddress(char[] value) {
        address = value;
    }
}
