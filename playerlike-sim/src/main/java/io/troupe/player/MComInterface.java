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
public class MComInterface extends UnofferedDevice {
    public MComInterface(PlayerClient client) {
        super(client, "mcom");
    }

    public void sendConfigReq(PlayerMcomConfig value, int request) {
        throw notOffered();
    }

    public void Push(int type, String channel, char[] data) {
        throw notOffered();
    }

    public void Pop(int type, String channel) {
        throw notOffered();
    }

    public void Read(int type, String channel) {
        throw notOffered();
    }

    public void Clear(int type, String channel) {
        throw notOffered();
    }

    public void setCapacity(int type, String channel, char capacity) {
        throw notOffered();
    }

    public PlayerMcomData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
