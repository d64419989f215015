package io.troupe.player.structures.power;

/** A setting or a question of a battery; no device here uses it. */
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
