package io.troupe.player.structures.graphics2d;

import io.troupe.player.structures.PlayerColor;
import io.troupe.player.structures.PlayerPoint2d;

/** A command of the Player interface graphics2d. This client does not use it. */
public class PlayerGraphics2dCmdPolyline {
    private int count;
    private PlayerPoint2d[] points = new PlayerPoint2d[0];
    private PlayerColor color = new PlayerColor();

    public synchronized int getCount() {
        return count;
    }

    public synchronized void setCount(int value) {
        count = value;
    }

    public synchronized PlayerPoint2d[] getPoints() {
        return points;
    }

    public synchronized void setPoints(PlayerPoint2d[] value) {
        points = value;
    }

    public synchronized PlayerColor getColor() {
        return color;
    }

    public synchronized void setColor(PlayerColor value) {
        color = value;
    }
}
