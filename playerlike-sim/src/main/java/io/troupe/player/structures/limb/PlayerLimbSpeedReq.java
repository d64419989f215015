package io.troupe.player.structures.limb;

/** A request of the Player interface limb. This client does not use it. */
public class PlayerLimbSpeedReq {
    private float speed;

    public synchronized float getSpeed() {
        return speed;
    }

    public synchronized void setSpeed(float value) {
        speed = value;
    }
}
