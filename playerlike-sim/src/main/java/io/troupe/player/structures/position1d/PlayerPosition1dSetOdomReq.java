package io.troupe.player.structures.position1d;

/** A request of the Player interface position1d. This client does not use it. */
public class PlayerPosition1dSetOdomReq {
    private float pos;

    public synchronized float getPos() {
        return pos;
    }

    public synchronized void setPos(float value) {
        pos = value;
    }
}
