package io.troupe.player.structures.power;

/** Data of the Player interface power. This client does not use it. */
public class PlayerPowerData {
    private int valid;
    private float volts;
    private float percent;
    private float joules;
    private float watts;
    private int charging;

    public synchronized int getValid() {
        return valid;
    }

    public synchronized void setValid(int value) {
        valid = value;
    }

    public synchronized float getVolts() {
        return volts;
    }

    public synchronized void setVolts(float value) {
        volts = value;
    }

    public synchronized float getPercent() {
        return percent;
    }

    public synchronized void setPercent(float value) {
        percent = value;
    }

    public synchronized float getJoules() {
        return joules;
    }

    public synchronized void setJoules(float value) {
        joules = value;
    }

    public synchronized float getWatts() {
        return watts;
    }

    public synchronized void setWatts(float value) {
        watts = value;
    }

    public synchronized int getCharging() {
        return charging;
    }

    public synchronized void setCharging(int value) {
        charging = value;
    }
}
