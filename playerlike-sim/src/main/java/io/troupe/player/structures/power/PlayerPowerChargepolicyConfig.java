package io.troupe.player.structures.power;

/** A request of the Player interface power. This client does not use it. */
public class PlayerPowerChargepolicyConfig {
    private byte enable_input;
    private byte enable_output;

    public synchronized byte getEnable_input() {
        return enable_input;
    }

    public synchronized void setEnable_input(byte value) {
        enable_input = value;
    }

    public synchronized byte getEnable_output() {
        return enable_output;
    }

    public synchronized void setEnable_output(byte value) {
        enable_output = value;
    }
}
