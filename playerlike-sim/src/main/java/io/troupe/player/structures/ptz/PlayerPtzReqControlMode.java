package io.troupe.player.structures.ptz;

/** A setting or a question of a camera that pans, tilts and zooms; no device here uses it. */
public class PlayerPtzReqControlMode {
    private int mode;

    public synchronized int getMode() {
        return mode;
    }

    public synchronized void setMode(int value) {
        mode = value;
    }
}
