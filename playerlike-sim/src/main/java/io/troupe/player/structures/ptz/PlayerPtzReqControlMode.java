package io.troupe.player.structures.ptz;

/** A request of the Player interface ptz. This client does not use it. */
public class PlayerPtzReqControlMode {
    private int mode;

    public synchronized int getMode() {
        return mode;
    }

    public synchronized void setMode(int value) {
        mode = value;
    }
}
