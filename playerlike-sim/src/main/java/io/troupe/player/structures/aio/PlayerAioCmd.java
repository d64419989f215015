package io.troupe.player.structures.aio;

/** A command of the Player interface aio. This client does not use it. */
public class PlayerAioCmd {
    private int id;
    private float voltage;

    public synchronized int getId() {
        return id;
    }

    public synchronized void setId(int value) {
        id = value;
    }

    public synchronized float getVoltage() {
        return voltage;
    }

    public synchronized void setVoltage(float value) {
        voltage = value;
    }
}
