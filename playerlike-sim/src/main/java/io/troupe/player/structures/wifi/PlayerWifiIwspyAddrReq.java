package io.troupe.player.structures.wifi;

/** A request of the Player interface wifi. This client does not use it. */
public class PlayerWifiIwspyAddrReq {
    private char[] address = new char[0];

    public synchronized char[] getAddress() {
        return address;
    }

    public synchronized void setAddress(char[] value) {
        address = value;
    }
}
