package io.troupe.player;

import io.troupe.player.structures.wifi.PlayerWifiData;

/**
 * A wireless network, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface wifi.
 */
public class WiFiInterface extends UnofferedDevice {
    public WiFiInterface(PlayerClient client) {
        super(client, "wifi");
    }

    public PlayerWifiData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public void queryWifiMac() {
        throw notOffered();
    }

    public void queryWifiIwspyAddrAdd() {
        throw notOffered();
    }
}
