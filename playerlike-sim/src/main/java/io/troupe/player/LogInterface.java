package io.troupe.player;

import io.troupe.player.structures.log.PlayerLogGetState;

/**
 * Data logging. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface log.
 */
public class LogInterface extends UnofferedDevice {
    public LogInterface(PlayerClient client) {
        super(client, "log");
    }

    public void setWriteState(int state) {
        throw notOffered();
    }

    public void setReadState(int state) {
        throw notOffered();
    }

    public void rewindPlayback() {
        throw notOffered();
    }

    public void queryState() {
        throw notOffered();
    }

    public void setFileName(String fileName) {
        throw notOffered();
    }

    public PlayerLogGetState getState() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
