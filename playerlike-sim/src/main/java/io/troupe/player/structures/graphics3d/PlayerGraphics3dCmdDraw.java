package io.troupe.player.structures.graphics3d;

import io.troupe.player.structures.PlayerColor;
import io.troupe.player.structures.PlayerPoint3d;

/** A command of the Player interface graphics3d. This client does not use it. */
public class PlayerGraphics3dCmdDraw {
    private int draw_mode;
    private int count;
    private PlayerPoint3d[] points = new PlayerPoint3d[0];
    private PlayerColor color = new PlayerColor();

    public synchronized int getDraw_mode() {
        return draw_mode;
    }

    public synchronized void setDraw_mode(int value) {
        draw_mode = value;
    }

    public synchronized int getCount() {
        return count;
    }

    public synchronized void setCount(int value) {
        count = value;
    }

    public synchronized PlayerPoint3d[] getPoints() {
        return points;
    }

    public synchronized void setPoints(PlayerPoint3d[] value) {
        points = value;
    }

    public synchronized PlayerColor getColor() {
        return color;
    }

    public synchronized void setColor(PlayerColor value) {
        color = value;
    }
}
