package io.troupe.player.structures.simulation;

/** A command of the simulation interface, named as in the original client. */
public class PlayerSimulationCmd {
    private byte cmd;

    public synchronized byte getCmd() {
        return cmd;
    }

    public synchronized void setCmd(byte value) {
        cmd = value;
    }
}
