package io.troupe.player;

import io.troupe.player.structures.mcom.PlayerMcomConfig;
import io.troupe.player.structures.mcom.PlayerMcomData;

/**
 * Messages stored for other clients. This client does not support it; the class exists so that programs that mention it
 * compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface mcom.
 */
public class MComInterface extends UnsupportedDevice {
    public MComInterface(PlayerClient client) {
        super(client, "mcom");
    }

    public void sendConfigReq(PlayerMcomConfig value, int request) {
        throw notSupported();
    }

    public void Push(int type, String channel, char[] data) {
        throw notSupported();
    }

    public void Pop(int type, String channel) {
        throw notSupported();
    }

    public void Read(int type, String channel) {
        throw notSupported();
    }

    public void Clear(int type, String channel) {
        throw notSupported();
    }

    public void setCapacity(int type, String channel, char capacity) {
        throw notSupported();
    }

    public PlayerMcomData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
