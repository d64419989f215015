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
public class LogInterface extends UnsupportedDevice {
    public LogInterface(PlayerClient client) {
        super(client, "log");
    }

    public void setWriteState(int state) {
        throw notSupported();
    }

    public void setReadState(int state) {
        throw notSupported();
    }

    public void rewindPlayback() {
        throw notSupported();
    }

    public void queryState() {
        throw notSupported();
    }

    public void setFileName(String fileName) {
        throw notSupported();
    }

    public PlayerLogGetState getState() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
