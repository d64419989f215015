package io.troupe.player.structures.position2d;

/** A request of the Player interface position2d, named as in the original client. */
public class PlayerPosition2dSpeedProfReq {
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
