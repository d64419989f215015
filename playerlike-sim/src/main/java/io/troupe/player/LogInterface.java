package io.troupe.player;

import io.troupe.player.structures.log.PlayerLogGetState;

/**
 * A recorder, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
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
