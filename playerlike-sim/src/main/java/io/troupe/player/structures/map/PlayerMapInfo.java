package io.troupe.player.structures.map;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** Part of a message of the Player interface map. This client does not use it. */
public class PlayerMapInfo {
    private float scale;
    private int width;
    private int height;
    private PlayerPose origin = new PlayerPose();

    public synchronized float getScale() {
        return scale;
    }

    public synchronized void setScale(float value) {
        scale = value;
    }

    public synchronized int getWidth() {
        return width;
    }

    public synchronized void setWidth(int value) {
        width = value;
    }

    public synchronized int getHeight() {
        return height;
    }

    public synchronized void setHeight(int value) {
        height = value;
    }

    public synchronized PlayerPose getOrigin() {
        return origin;
    }

    public synchronized void setOrigin(PlayerPose2d value) {
        origin = PlayerPose.of(value);
    }
}
