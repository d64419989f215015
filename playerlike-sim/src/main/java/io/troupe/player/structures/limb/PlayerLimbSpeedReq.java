package io.troupe.player.structures.limb;

/** A setting or a question of an arm; no device here uses it. */
public class PlayerLimbSpeedReq {
    private float speed;

    public synchronized float getSpeed() {
        return speed;
    }

    public synchronized void setSpeed(float value) {
        speed = value;
    }
}
