package io.troupe.player.structures.blinkenlight;

import io.troupe.player.structures.PlayerColor;

/** Data of the Player interface blinkenlight. This client does not use it. */
public class PlayerBlinkenlightData {
    private byte enable;
    private float period;
    private float dutycycle;
    private PlayerColor color = new PlayerColor();

    public synchronized byte getEnable() {
        return enable;
    }

    public synchronized void setEnable(byte value) {
        enable = value;
    }

    public synchronized float getPeriod() {
        return period;
    }

    public synchronized void setPeriod(float value) {
        period = value;
    }

    public synchronized float getDutycycle() {
        return dutycycle;
    }

    public synchronized void setDutycycle(float value) {
        dutycycle = value;
    }

    public synchronized PlayerColor getColor() {
        return color;
    }

    public synchronized void setColor(PlayerColor value) {
        color = value;
    }
}
