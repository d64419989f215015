package io.troupe.player.structures.position1d;

/** A setting or a question of a linear actuator; no device here uses it. */
public class PlayerPosition1dSpeedProfReq {
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
