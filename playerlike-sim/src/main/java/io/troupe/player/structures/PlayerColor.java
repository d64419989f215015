package io.troupe.player.structures;

/** A colour; components from 0 to 255, alpha 0 is transparent. */
public class PlayerColor {
    private int alpha;
    private int red;
    private int green;
    private int blue;

    public synchronized int getAlpha() {
        return alpha;
    }

    public synchronized void setAlpha(int value) {
        alpha = value;
    }

    public synchronized int getRed() {
        return red;
    }

    public synchronized void setRed(int value) {
        red = value;
    }

    public synchronized int getGreen() {
        return green;
    }

    public synchronized void setGreen(int value) {
        green = value;
    }

    public synchronized int getBlue() {
        return blue;
    }

    public synchronized void setBlue(int value) {
        blue = value;
    }
}
