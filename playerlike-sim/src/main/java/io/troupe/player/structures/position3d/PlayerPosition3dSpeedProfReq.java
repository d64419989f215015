package io.troupe.player.structures.position3d;

/** A request of the Player interface position3d. This client does not use it. */
public class PlayerPosition3dSpeedProfReq {
    private float speed;
    private float acc;

    public synchronized float getSpeed() {
        return speed;
    }

    public synchronized void setSpeed(float value) {
        speed = value;
    }

    public synchronized float getAcc() {
        return acc;
    }

    public synchronized void setAcc(float value) {
        acc = value;
    }
}
