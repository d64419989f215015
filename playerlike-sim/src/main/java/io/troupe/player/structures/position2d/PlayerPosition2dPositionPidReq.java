package io.troupe.player.structures.position2d;

/** A request of the Player interface position2d, named as in the original client. */
public class PlayerPosition2dPositionPidReq {
    private float kp;
    private float ki;
    private float kd;

    public synchronized float getKp() {
        return kp;
    }

    public synchronized void setKp(float value) {
        kp = value;
    }

    public synchronized float getKi() {
        return ki;
    }

    public synchronized void setKi(float value) {
        ki = value;
    }

    public synchronized float getKd() {
        return kd;
    }

    public synchronized void setKd(float value) {
        kd = value;
    }
}
