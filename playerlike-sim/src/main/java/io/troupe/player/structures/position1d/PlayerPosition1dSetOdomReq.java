package io.troupe.player.structures.position1d;

/** A setting or a question of a linear actuator; no device here uses it. */
public class PlayerPosition1dSetOdomReq {
    private float pos;

    public synchronized float getPos() {
        return pos;
    }

    public synchronized void setPos(float value) {
        pos = value;
    }
}
