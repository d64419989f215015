package io.troupe.player.structures.position1d;

/** A command of the Player interface position1d. This client does not use it. */
public class PlayerPosition1dCmdVel {
    private float vel;
    private byte state;

    public synchronized float getVel() {
        return vel;
    }

    public synchronized void setVel(float value) {
        vel = value;
    }

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }
}
