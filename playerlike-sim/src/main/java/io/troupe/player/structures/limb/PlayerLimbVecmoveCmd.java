package io.troupe.player.structures.limb;

/** A command of the Player interface limb. This client does not use it. */
public class PlayerLimbVecmoveCmd {
    private float x;
    private float y;
    private float z;
    private float length;

    public synchronized float getX() {
        return x;
    }

    public synchronized void setX(float value) {
        x = value;
    }

    public synchronized float getY() {
        return y;
    }

    public synchronized void setY(float value) {
        y = value;
    }

    public synchronized float getZ() {
        return z;
    }

    public synchronized void setZ(float value) {
        z = value;
    }

    public synchronized float getLength() {
        return length;
    }

    public synchronized void setLength(float value) {
        length = value;
    }
}
