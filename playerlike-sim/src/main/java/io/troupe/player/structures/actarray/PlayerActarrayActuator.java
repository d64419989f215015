package io.troupe.player.structures.actarray;

/** Part of a message of the Player interface actarray. This client does not use it. */
public class PlayerActarrayActuator {
    private float position;
    private float speed;
    private byte state;
    private float acceleration;
    private float current;

    public synchronized float getPosition() {
        return position;
    }

    public synchronized void setPosition(float value) {
        position = value;
    }

    public synchronized float getSpeed() {
        return speed;
    }

    public synchronized void setSpeed(float value) {
        speed = value;
    }

    public synchronized byte getState() {
        return state;
    }

    public synchronized void setState(byte value) {
        state = value;
    }

    public synchronized float getAcceleration() {
        return acceleration;
    }

    public synchronized void setAcceleration(float value) {
        acceleration = value;
    }

    public synchronized float getCurrent() {
        return current;
    }

    public synchronized void setCurrent(float value) {
        current = value;
    }
}
