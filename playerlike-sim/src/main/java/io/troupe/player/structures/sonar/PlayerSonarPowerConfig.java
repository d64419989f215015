package io.troupe.player.structures.sonar;

/** A setting or a question of the sonar interface, by its name in the original client. */
public class PlayerSonarPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
