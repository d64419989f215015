package io.troupe.player;

import io.troupe.player.structures.wifi.PlayerWifiData;

/**
 * A wireless network. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface wifi.
 */
public class WiFiInterface extends UnsupportedDevice {
    public WiFiInterface(PlayerClient client) {
        super(client, "wifi");
    }

    public PlayerWifiData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public void queryWifiMac() {
        throw notSupported();
    }

    public void queryWifiIwspyAddrAdd() {
        throw notSupported();
    }
}
