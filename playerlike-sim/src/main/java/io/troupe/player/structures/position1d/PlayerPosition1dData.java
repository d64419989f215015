package io.troupe.player.structures.position1d;

/** Data of the Player interface position1d. This client does not use it. */
public class PlayerPosition1dData {
    private float pos;
    private float vel;
    private byte stall;
    private byte status;

    public synchronized float getPos() {
        return pos;
    }

    public synchronized void setPos(float value) {
        pos = value;
    }

    public synchronized float getVel() {
        return vel;
    }

    public synchronized void setVel(float value) {
        vel = value;
    }

    public synchronized byte getStall() {
        return stall;
    }

    public synchronized void setStall(byte value) {
        stall = value;
    }

    public synchronized byte getStatus() {
        return status;
    }

    public synchronized void setStatus(byte value) {
        status = value;
    }
}
