package io.troupe.player.structures.sonar;

/** A request of the Player interface sonar, named as in the original client. */
public class PlayerSonarPowerConfig {
    private byte state;

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
