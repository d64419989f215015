package io.troupe.player.structures.health;

/** Part of a message of the Player interface health. This client does not use it. */
public class PlayerHealthCpu {
    private float idle;
    private float system;
    private float user;

    public synchronized float getIdle() {
        return idle;
    }

    public synchronized void setIdle(float value) {
        idle = value;
    }

    public synchronized float getSystem() {
        return system;
    }

    public synchronized void setSystem(float value) {
        system = value;
    }

    public synchronized float getUser() {
        return user;
    }

    public synchronized void setUser(float value) {
        user = value;
    }
}
