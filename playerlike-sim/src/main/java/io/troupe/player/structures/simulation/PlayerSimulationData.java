package io.troupe.player.structures.simulation;

/** Data of the simulation interface, named as in the original client. */
public class PlayerSimulationData {
    private byte data;

    public synchronized byte getData() {
        return data;
    }

    public synchronized void setData(byte value) {
        data = value;
    }
}
