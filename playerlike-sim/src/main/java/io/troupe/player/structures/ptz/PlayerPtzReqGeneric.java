package io.troupe.player.structures.ptz;

/** A request of the Player interface ptz. This client does not use it. */
public class PlayerPtzReqGeneric {
    private int config_count;
    private int[] config = new int[0];

    public synchronized int getConfig_count() {
        return config_count;
    }

    public synchronized void setConfig_count(int value) {
        config_count = value;
    }

    public synchronized int[] getConfig() {
        return config;
    }

    public synchronized void setConfig(int[] value) {
        config = value;
    }
}
